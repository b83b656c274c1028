"""Vector of three numbers."""

import math

from .numbers import EPSILON, Numbers


class Vector(Numbers):
    """x, y, z; `*` of two vectors is the cross product."""

    __slots__ = ()
    size = 3

    def __init__(self, x: "Vector | float" = 0.0, y: float | None = None, z: float | None = None) -> None:
        """Zeros, three numbers, or a copy of a Vector."""
        if isinstance(x, Vector) and y is None and z is None:
            self._values = list(x._values)
        elif not isinstance(x, Vector) and y is not None and z is not None:
            self._values = [float(x), float(y), float(z)]
        elif y is None and z is None and x == 0.0:
            self._values = [0.0, 0.0, 0.0]
        else:
            raise TypeError(f"Vector takes nothing, three numbers or a Vector, not ({x!r}, {y!r}, {z!r})")

    def x(self, value: float | None = None) -> float | None:
        """First component; with an argument: set it."""
        return self._component(0, value)

    def y(self, value: float | None = None) -> float | None:
        """Second component; with an argument: set it."""
        return self._component(1, value)

    def z(self, value: float | None = None) -> float | None:
        """Third component; with an argument: set it."""
        return self._component(2, value)

    def _component(self, index: int, value: float | None) -> float | None:
        if value is None:
            return self._values[index]
        self._values[index] = float(value)
        return None

    def __mul__(self, other: object) -> "Vector":
        if not isinstance(other, Vector):
            return super().__mul__(other)
        (a, b, c), (x, y, z) = self._values, other._values
        return Vector(b * z - c * y, c * x - a * z, a * y - b * x)

    def Norm(self, eps: float = EPSILON) -> float:
        """Length."""
        return math.sqrt(sum(value * value for value in self._values))

    def Normalize(self, eps: float = EPSILON) -> float:
        """Scale to length 1 in place, and return the length it had; to (1, 0, 0) if the length was below `eps`."""
        length = self.Norm()
        self._values = [1.0, 0.0, 0.0] if length < eps else [value / length for value in self._values]
        return length
