"""Times and durations with genpy's interface, for update rules."""

import functools
from typing import Self

from trundle.spatial import NS_PER_S


@functools.total_ordering
class TVal:
    """Seconds and nanoseconds; base class of `Time` and `Duration`."""

    __slots__ = ("nsecs", "secs")

    def __init__(self, secs: float = 0, nsecs: int = 0) -> None:
        """Create from whole seconds and nanoseconds, or from fractional seconds alone."""
        ns = round(secs * NS_PER_S) if isinstance(secs, float) else int(secs) * NS_PER_S
        self.secs, self.nsecs = divmod(ns + int(nsecs), NS_PER_S)

    @classmethod
    def from_sec(cls, seconds: float) -> Self:
        """Create from seconds."""
        return cls(0, round(seconds * NS_PER_S))

    def to_sec(self) -> float:
        """Value in seconds."""
        return self.secs + self.nsecs / 1e9

    def to_nsec(self) -> int:
        """Value in nanoseconds."""
        return self.secs * NS_PER_S + self.nsecs

    def is_zero(self) -> bool:
        """True if the value is 0."""
        return self.to_nsec() == 0

    def __bool__(self) -> bool:
        return not self.is_zero()

    def __eq__(self, other: object) -> bool:
        if not hasattr(other, "nsecs"):
            return NotImplemented
        return self.to_nsec() == _ns(other)

    def __lt__(self, other: "TVal") -> bool:
        return self.to_nsec() < _ns(other)

    def __hash__(self) -> int:
        return hash(self.to_nsec())

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.secs}, {self.nsecs})"


class Duration(TVal):
    """A time span; may be negative."""

    __slots__ = ()

    def __add__(self, other: TVal) -> TVal:
        return type(other)(0, self.to_nsec() + _ns(other))

    def __sub__(self, other: "Duration") -> "Duration":
        return Duration(0, self.to_nsec() - _ns(other))

    def __mul__(self, factor: float) -> "Duration":
        return Duration(0, round(self.to_nsec() * factor))

    __rmul__ = __mul__

    def __truediv__(self, factor: float) -> "Duration":
        return self * (1 / factor)

    def __neg__(self) -> "Duration":
        return Duration(0, -self.to_nsec())

    def __abs__(self) -> "Duration":
        return Duration(0, abs(self.to_nsec()))


class Time(TVal):
    """A point in time."""

    __slots__ = ()

    def __add__(self, other: Duration) -> "Time":
        return Time(0, self.to_nsec() + _ns(other))

    def __sub__(self, other: TVal) -> TVal:
        result_class = Time if isinstance(other, Duration) else Duration
        return result_class(0, self.to_nsec() - _ns(other))


def _ns(instant: object) -> int:
    """Nanoseconds of an instance of this module or of genpy."""
    return getattr(instant, "secs", 0) * NS_PER_S + getattr(instant, "nsecs", 0)
