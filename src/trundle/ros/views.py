"""Messages as expressions written for rospy expect them: `m.header.stamp.to_sec() > 5`, `t.secs`."""

import functools
from typing import Any

from .messages import Message
from .type_texts import ros_name


@functools.total_ordering
class MessageView:
    """A message, or a time in it, seen as rospy shows it; arrays and numbers are as they are."""

    __slots__ = ("_message",)

    def __init__(self, message: Message) -> None:
        self._message = message

    def __getattr__(self, name: str) -> Any:
        message = self._message
        if name == "_type":
            return ros_name(message.__msgtype__)
        if hasattr(message, "nanosec") and name in ("secs", "nsecs"):
            return message.sec if name == "secs" else message.nanosec
        for field in (name, f"{name}_"):
            if hasattr(message, field):
                return _seen(getattr(message, field))
        raise AttributeError(f"no field named {name} in {ros_name(message.__msgtype__)}")

    def to_nsec(self) -> int:
        """A time or duration [ns]."""
        return self._message.sec * 10**9 + self._message.nanosec

    def to_sec(self) -> float:
        """A time or duration [s]."""
        return self.to_nsec() / 1e9

    def is_zero(self) -> bool:
        """Whether a time is not set."""
        return self.to_nsec() == 0

    def __eq__(self, other: object) -> bool:
        return self._message == (other._message if isinstance(other, MessageView) else other)

    def __lt__(self, other: "MessageView") -> bool:
        return self.to_nsec() < other.to_nsec()

    def __hash__(self) -> int:
        return hash(repr(self._message))

    def __repr__(self) -> str:
        return repr(self._message)


def _seen(value: Any) -> Any:
    if isinstance(value, list):
        return [_seen(item) for item in value]
    return MessageView(value) if hasattr(value, "__msgtype__") else value
