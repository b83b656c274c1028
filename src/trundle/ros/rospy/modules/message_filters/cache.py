"""Cache of the last messages, looked up by time."""

from collections.abc import Iterator
from typing import Any

import genpy

from .simple_filter import SimpleFilter, stamp_of


class Cache(SimpleFilter):
    """Keeps the last messages of a filter, and passes them on."""

    def __init__(self, f: SimpleFilter, cache_size: int = 1, allow_headerless: bool = False) -> None:
        """Connect to a filter.

        Args:
            f: source of the messages.
            cache_size: number of messages kept.
            allow_headerless: stamp messages without a header on arrival, instead of dropping them.
        """
        super().__init__()
        self.cache_size = cache_size
        self.allow_headerless = allow_headerless
        self.cache_msgs: list[Any] = []
        self.cache_times: list[genpy.Time] = []
        self.connectInput(f)

    def connectInput(self, f: SimpleFilter) -> None:
        """Receive the messages of a filter."""
        self.incoming_connection = f.registerCallback(self.add)

    def add(self, msg: Any) -> None:
        """Keep a message."""
        stamp = stamp_of(msg, self.allow_headerless)
        if stamp is None:
            return
        self.cache_times.append(stamp)
        self.cache_msgs.append(msg)
        if len(self.cache_msgs) > self.cache_size:
            del self.cache_msgs[0], self.cache_times[0]
        self.signalMessage(msg)

    def getInterval(self, from_stamp: genpy.Time, to_stamp: genpy.Time) -> list[Any]:
        """Messages between two times, inclusive."""
        assert from_stamp <= to_stamp
        return [msg for msg, stamp in self._pairs() if from_stamp <= stamp <= to_stamp]

    def getElemAfterTime(self, stamp: genpy.Time) -> Any:
        """First message kept that is not older than a time, or None."""
        return next((msg for msg, msg_stamp in self._pairs() if msg_stamp >= stamp), None)

    def getElemBeforeTime(self, stamp: genpy.Time) -> Any:
        """Last message kept that is not newer than a time, or None."""
        older = [msg for msg, msg_stamp in self._pairs() if msg_stamp <= stamp]
        return older[-1] if older else None

    def getLatestTime(self) -> genpy.Time | None:
        """Stamp of the last message, or None."""
        return self.cache_times[-1] if self.cache_times else None

    def getLastestTime(self) -> genpy.Time | None:
        """`getLatestTime`, as it was once spelled."""
        return self.getLatestTime()

    def getOldestTime(self) -> genpy.Time | None:
        """Stamp of the first message kept, or None."""
        return self.cache_times[0] if self.cache_times else None

    def getLast(self) -> Any:
        """First kept message with the latest stamp; None without messages."""
        latest = self.getLatestTime()
        return None if latest is None else self.getElemAfterTime(latest)

    def _pairs(self) -> Iterator[tuple[Any, genpy.Time]]:
        return zip(list(self.cache_msgs), list(self.cache_times), strict=True)
