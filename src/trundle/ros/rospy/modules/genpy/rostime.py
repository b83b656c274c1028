"""ROS' time and duration: integer seconds and nanoseconds."""

import numbers
from typing import Any, ClassVar

NS = 1_000_000_000


def _canon(secs: int, nsecs: int) -> tuple[int, int]:
    over, nsecs = divmod(nsecs, NS)
    return secs + over, nsecs


class TVal:
    """Base class of `Time` and `Duration`."""

    __slots__ = ["nsecs", "secs"]
    _slot_types: ClassVar = ["int32", "int32"]

    secs: int
    nsecs: int

    def __init__(self, secs: float = 0, nsecs: int = 0) -> None:
        """Create from whole seconds and nanoseconds, or from a float of seconds alone.

        Raises:
            ValueError: a float of seconds, and nanoseconds.
        """
        if not isinstance(secs, numbers.Integral):
            if nsecs != 0:
                raise ValueError("if secs is a float, nsecs cannot be set")
            whole = int(secs)
            secs, nsecs = whole, int((secs - whole) * NS)
        self.secs, self.nsecs = _canon(int(secs), int(nsecs))

    @classmethod
    def from_sec(cls, float_secs: float) -> Any:
        """Create from seconds."""
        secs = int(float_secs)
        return cls(secs, int((float_secs - secs) * NS))

    def is_zero(self) -> bool:
        """True if zero."""
        return self.secs == 0 and self.nsecs == 0

    def set(self, secs: int, nsecs: int) -> None:
        """Set both fields without normalizing."""
        self.secs = secs
        self.nsecs = nsecs

    def canon(self) -> None:
        """Normalize nanoseconds into 0 to 1e9."""
        self.secs, self.nsecs = _canon(self.secs, self.nsecs)

    def to_sec(self) -> float:
        """Seconds."""
        return float(self.secs) + float(self.nsecs) / 1e9

    def to_nsec(self) -> int:
        """Nanoseconds."""
        return self.secs * NS + self.nsecs

    def __getstate__(self) -> list[int]:
        return [self.secs, self.nsecs]

    def __setstate__(self, state: list[int]) -> None:
        self.secs, self.nsecs = state

    def __hash__(self) -> int:
        return hash((self.secs, self.nsecs))

    def __str__(self) -> str:
        return str(self.to_nsec())

    def __repr__(self) -> str:
        return f"genpy.TVal[{self.to_nsec()}]"

    def __bool__(self) -> bool:
        return self.secs != 0 or self.nsecs != 0

    def __nonzero__(self) -> bool:
        return bool(self)

    def __lt__(self, other: object) -> bool:
        return self.__cmp__(other) < 0 if isinstance(other, TVal) and self._compares(other) else NotImplemented

    def __le__(self, other: object) -> bool:
        return self.__cmp__(other) <= 0 if isinstance(other, TVal) and self._compares(other) else NotImplemented

    def __gt__(self, other: object) -> bool:
        return self.__cmp__(other) > 0 if isinstance(other, TVal) and self._compares(other) else NotImplemented

    def __ge__(self, other: object) -> bool:
        return self.__cmp__(other) >= 0 if isinstance(other, TVal) and self._compares(other) else NotImplemented

    def __eq__(self, other: object) -> bool:
        return isinstance(other, TVal) and self._compares(other) and self.to_nsec() == other.to_nsec()

    def __ne__(self, other: object) -> bool:
        return not self == other

    def __cmp__(self, other: Any) -> int:
        if not isinstance(other, TVal):
            raise TypeError("Cannot compare to non-TVal")
        if not self._compares(other):
            raise TypeError(f"cannot compare to non-{type(self).__name__}")
        ours, theirs = self.to_nsec(), other.to_nsec()
        return (ours > theirs) - (ours < theirs)

    def _compares(self, other: "TVal") -> bool:
        """True if the other value has a type that this one compares with."""
        del other
        return True


class Time(TVal):
    """A point in time since 1970, or since the simulation's start."""

    __slots__ = ["nsecs", "secs"]

    def __init__(self, secs: float = 0, nsecs: int = 0) -> None:
        """Create; see `TVal`.

        Raises:
            TypeError: before 1970.
        """
        super().__init__(secs, nsecs)
        if self.secs < 0:
            raise TypeError("time values must be positive")

    def to_time(self) -> float:
        """Seconds."""
        return self.to_sec()

    def __repr__(self) -> str:
        return f"genpy.Time[{self.to_nsec()}]"

    def __add__(self, other: Any) -> Any:
        if not isinstance(other, Duration):
            return NotImplemented
        return type(self)(self.secs + other.secs, self.nsecs + other.nsecs)

    __radd__ = __add__

    def __sub__(self, other: Any) -> Any:
        if isinstance(other, Time):
            return Duration(self.secs - other.secs, self.nsecs - other.nsecs)
        if isinstance(other, Duration):
            return type(self)(self.secs - other.secs, self.nsecs - other.nsecs)
        return NotImplemented

    def __hash__(self) -> int:
        return super().__hash__()

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Time) and self.secs == other.secs and self.nsecs == other.nsecs

    def _compares(self, other: TVal) -> bool:
        return isinstance(other, Time)


class Duration(TVal):
    """A length of time, possibly negative."""

    __slots__ = ["nsecs", "secs"]

    def __repr__(self) -> str:
        return f"genpy.Duration[{self.to_nsec()}]"

    def __neg__(self) -> "Duration":
        return type(self)(-self.secs, -self.nsecs)

    def __abs__(self) -> "Duration":
        return self if self.secs >= 0 else -self

    def __add__(self, other: Any) -> Any:
        if not isinstance(other, Duration):
            return NotImplemented
        return type(self)(self.secs + other.secs, self.nsecs + other.nsecs)

    __radd__ = __add__

    def __sub__(self, other: Any) -> Any:
        if not isinstance(other, Duration):
            return NotImplemented
        return type(self)(self.secs - other.secs, self.nsecs - other.nsecs)

    def __mul__(self, val: Any) -> Any:
        if isinstance(val, numbers.Integral):
            return type(self)(self.secs * int(val), self.nsecs * int(val))
        if isinstance(val, numbers.Real):
            return type(self).from_sec(self.to_sec() * float(val))
        return NotImplemented

    __rmul__ = __mul__

    def __floordiv__(self, val: Any) -> Any:
        if isinstance(val, Duration):
            return int(self.to_sec() // val.to_sec())
        if isinstance(val, numbers.Real):
            return type(self).from_sec(self.to_sec() // float(val))
        return NotImplemented

    def __truediv__(self, val: Any) -> Any:
        if isinstance(val, Duration):
            return self.to_sec() / val.to_sec()
        if isinstance(val, numbers.Real):
            return type(self).from_sec(self.to_sec() / float(val))
        return NotImplemented

    __div__ = __truediv__

    def __mod__(self, val: Any) -> Any:
        if isinstance(val, Duration):
            return type(self).from_sec(self.to_sec() % val.to_sec())
        return NotImplemented

    def __divmod__(self, val: Any) -> Any:
        if not isinstance(val, Duration):
            return NotImplemented
        quotient, rest = divmod(self.to_sec(), val.to_sec())
        return int(quotient), type(self).from_sec(rest)

    def __hash__(self) -> int:
        return super().__hash__()

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Duration) and self.secs == other.secs and self.nsecs == other.nsecs

    def _compares(self, other: TVal) -> bool:
        return isinstance(other, Duration)
