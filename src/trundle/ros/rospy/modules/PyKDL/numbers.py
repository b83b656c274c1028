"""Base of the types that are a list of numbers."""

EPSILON = 1e-6
"""Differences smaller than this do not count."""


def text(value):
    """A number, 12 characters wide."""
    return f"{value:12g}"


class Numbers:
    """A fixed count of numbers, with the arithmetic of vectors."""

    __slots__ = ("_values",)
    __hash__ = None
    size = 0

    @classmethod
    def _of(cls, values):
        new = cls.__new__(cls)
        new._values = [float(value) for value in values]
        return new

    @classmethod
    def Zero(cls):
        """All zeros."""
        return cls._of([0.0] * cls.size)

    def __getitem__(self, index):
        self._check(index)
        return self._values[index]

    def __setitem__(self, index, value):
        self._check(index)
        self._values[index] = float(value)

    def _check(self, index):
        if not 0 <= index < self.size:
            raise IndexError(f"{type(self).__name__} index out of range")

    def __add__(self, other):
        if type(other) is not type(self):
            return NotImplemented
        return self._of(a + b for a, b in zip(self._values, other._values, strict=True))

    def __sub__(self, other):
        if type(other) is not type(self):
            return NotImplemented
        return self._of(a - b for a, b in zip(self._values, other._values, strict=True))

    def __iadd__(self, other):
        self._values = (self + other)._values
        return self

    def __isub__(self, other):
        self._values = (self - other)._values
        return self

    def __neg__(self):
        return self._of(-value for value in self._values)

    def __mul__(self, factor):
        if not isinstance(factor, int | float):
            return NotImplemented
        return self._of(value * factor for value in self._values)

    __rmul__ = __mul__

    def __truediv__(self, divisor):
        return self._of(value / divisor for value in self._values)

    def __eq__(self, other):
        return type(other) is type(self) and self.is_close(other, EPSILON)

    def is_close(self, other, eps):
        """True if no two numbers differ by `eps` or more."""
        return all(abs(a - b) < eps for a, b in zip(self._values, other._values, strict=True))

    def ReverseSign(self):
        """Negate in place."""
        self._values = [-value for value in self._values]

    def __copy__(self):
        return self._of(self._values)

    def __deepcopy__(self, memo):
        return self._of(self._values)

    def __reduce__(self):
        return _restore, (type(self), list(self._values))

    def __repr__(self):
        return "[" + ",".join(text(value) for value in self._values) + "]"


def _restore(cls, values):
    return cls._of(values)
