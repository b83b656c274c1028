"""The last messages, to be asked for by time."""

from .simple_filter import SimpleFilter, stamp_of


class Cache(SimpleFilter):
    """Keeps the last messages of a filter, and passes them on."""

    def __init__(self, f, cache_size=1, allow_headerless=False):
        """Connect to a filter.

        Args:
            f: the filter.
            cache_size: number of messages kept.
            allow_headerless: stamp messages without a header on arrival, instead of dropping them.
        """
        super().__init__()
        self.cache_size = cache_size
        self.allow_headerless = allow_headerless
        self.cache_msgs = []
        self.cache_times = []
        self.connectInput(f)

    def connectInput(self, f):
        """Take the messages of a filter."""
        self.incoming_connection = f.registerCallback(self.add)

    def add(self, msg):
        """Keep a message."""
        stamp = stamp_of(msg, self.allow_headerless)
        if stamp is None:
            return
        self.cache_times.append(stamp)
        self.cache_msgs.append(msg)
        if len(self.cache_msgs) > self.cache_size:
            del self.cache_msgs[0], self.cache_times[0]
        self.signalMessage(msg)

    def getInterval(self, from_stamp, to_stamp):
        """Messages between two times, inclusive."""
        assert from_stamp <= to_stamp
        return [msg for msg, stamp in self._pairs() if from_stamp <= stamp <= to_stamp]

    def getElemAfterTime(self, stamp):
        """First message kept that is not older than a time, or None."""
        return next((msg for msg, when in self._pairs() if when >= stamp), None)

    def getElemBeforeTime(self, stamp):
        """Last message kept that is not newer than a time, or None."""
        older = [msg for msg, when in self._pairs() if when <= stamp]
        return older[-1] if older else None

    def getLatestTime(self):
        """Stamp of the last message, or None."""
        return self.cache_times[-1] if self.cache_times else None

    def getLastestTime(self):
        """`getLatestTime`, as it was once spelled."""
        return self.getLatestTime()

    def getOldestTime(self):
        """Stamp of the first message kept, or None."""
        return self.cache_times[0] if self.cache_times else None

    def getLast(self):
        """First message kept that has the stamp of the last one, or a newer one; None without messages."""
        return self.getElemAfterTime(self.getLatestTime()) if self.cache_msgs else None

    def _pairs(self):
        return zip(list(self.cache_msgs), list(self.cache_times), strict=True)
