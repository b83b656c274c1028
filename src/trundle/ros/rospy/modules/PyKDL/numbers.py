"""Base class of the types that are a list of numbers."""

from collections.abc import Iterable

TYPE_CHECKING = False  # not from `typing`, whose import takes longer than this package's
if TYPE_CHECKING:
    from collections.abc import Iterator
    from typing import Any, Self

EPSILON = 1e-6
"""Tolerance of equality, and length below which vectors and angles count as zero."""


def text(value: float) -> str:
    """Format a number, 12 characters wide."""
    return f"{value:12g}"


class Numbers:
    """A fixed count of numbers, with the arithmetic of vectors."""

    _values: list[float]

    __slots__ = ("_values",)
    __hash__ = None  # pyright: ignore[reportAssignmentType]
    size = 0

    @classmethod
    def _of(cls, values: Iterable[float]) -> "Self":
        new = cls.__new__(cls)
        new._values = [float(value) for value in values]
        return new

    @classmethod
    def Zero(cls) -> "Self":
        """All zeros."""
        return cls._of([0.0] * cls.size)

    def __getitem__(self, index: int) -> float:
        self._check(index)
        return self._values[index]

    def __setitem__(self, index: int, value: float) -> None:
        self._check(index)
        self._values[index] = float(value)

    def _check(self, index: int) -> None:
        if not 0 <= index < self.size:
            raise IndexError(f"{type(self).__name__} index out of range")

    if TYPE_CHECKING:

        def __iter__(self) -> "Iterator[float]": ...  # iteration by `__getitem__`

    def __add__(self, other: object) -> "Self":
        if type(other) is not type(self):
            return NotImplemented
        return self._of(a + b for a, b in zip(self._values, other._values, strict=True))

    def __sub__(self, other: object) -> "Self":
        if type(other) is not type(self):
            return NotImplemented
        return self._of(a - b for a, b in zip(self._values, other._values, strict=True))

    def __iadd__(self, other: object) -> "Self":
        self._values = (self + other)._values
        return self

    def __isub__(self, other: object) -> "Self":
        self._values = (self - other)._values
        return self

    def __neg__(self) -> "Self":
        return self._of(-value for value in self._values)

    def __mul__(self, factor: object) -> "Any":
        if not isinstance(factor, int | float):
            return NotImplemented
        return self._of(value * factor for value in self._values)

    __rmul__ = __mul__

    def __truediv__(self, divisor: float) -> "Self":
        return self._of(value / divisor for value in self._values)

    def __eq__(self, other: object) -> bool:
        return type(other) is type(self) and self.is_close(other, EPSILON)

    def is_close(self, other: "Numbers", eps: float) -> bool:
        """True if no two numbers differ by `eps` or more."""
        return all(abs(a - b) < eps for a, b in zip(self._values, other._values, strict=True))

    def ReverseSign(self) -> None:
        """Negate in place."""
        self._values = [-value for value in self._values]

    def __copy__(self) -> "Self":
        return self._of(self._values)

    def __deepcopy__(self, memo: object) -> "Self":
        return self._of(self._values)

    def __reduce__(self) -> tuple[object, ...]:
        return _restore, (type(self), list(self._values))

    def __repr__(self) -> str:
        return "[" + ",".join(text(value) for value in self._values) + "]"


def _restore(cls: type[Numbers], values: list[float]) -> Numbers:
    return cls._of(values)
