"""Messages with rospy's attributes, for user-written expressions: `m.header.stamp.to_sec() > 5`, `t.secs`."""

import functools
from typing import Any, cast

from .message_library import Message, Messages
from .printing import MessagePrinter
from .type_definitions import ros_name


@functools.total_ordering
class MessageView:
    """A message or time with rospy's attributes; arrays and numbers are unchanged."""

    __slots__ = ("_message", "_messages")

    def __init__(self, message: Message, messages: Messages | None = None) -> None:
        """Wrap a message; printing it needs its type store."""
        self._message = message
        self._messages = messages

    def __getattr__(self, name: str) -> object:
        message = self._message
        if name == "_type":
            return ros_name(message.__msgtype__)
        if hasattr(message, "nanosec") and name in ("secs", "nsecs"):
            return message.sec if name == "secs" else message.nanosec
        for field in (name, f"{name}_"):
            if hasattr(message, field):
                return _view(getattr(message, field), self._messages)
        raise AttributeError(f"no field named {name} in {ros_name(message.__msgtype__)}")

    def to_nsec(self) -> int:
        """Time or duration [ns]."""
        return self._message.sec * 10**9 + self._message.nanosec

    def to_sec(self) -> float:
        """Time or duration [s]."""
        return self.to_nsec() / 1e9

    def is_zero(self) -> bool:
        """True if the time is 0."""
        return self.to_nsec() == 0

    def __eq__(self, other: object) -> bool:
        return self._message == (other._message if isinstance(other, MessageView) else other)

    def __lt__(self, other: "MessageView") -> bool:
        return self.to_nsec() < other.to_nsec()

    def __sub__(self, other: "MessageView") -> "MessageView":
        ns = self.to_nsec() - other.to_nsec()
        return MessageView(type(self._message)(sec=ns // 10**9, nanosec=ns % 10**9))

    def __hash__(self) -> int:
        return hash(repr(self._message))

    def __repr__(self) -> str:
        return repr(self._message)

    def __str__(self) -> str:
        if hasattr(self._message, "nanosec"):
            return str(self.to_nsec())
        if self._messages is None:
            return repr(self._message)
        return MessagePrinter(messages=self._messages).text(self._message, ros_name(self._message.__msgtype__))


def _view(value: Any, messages: Messages | None) -> Any:
    if isinstance(value, list):
        return [_view(item, messages) for item in cast("list[Any]", value)]
    return MessageView(value, messages) if hasattr(value, "__msgtype__") else value
