"""Values of a chain's joints, and their effect on its tip."""

from .numbers import EPSILON, text
from .screws import Twist
from .vector import Vector


class JntArray:
    """A number for each joint."""

    __hash__ = None

    def __init__(self, size=0):
        """Zeros, or a copy."""
        if not isinstance(size, int | JntArray):
            raise TypeError(f"JntArray takes a size or a JntArray, not {size!r}")
        self._values = list(size._values) if isinstance(size, JntArray) else [0.0] * size

    def rows(self):
        """Count of numbers."""
        return len(self._values)

    def columns(self):
        """One, as a column of a matrix."""
        return 1

    def resize(self, size):
        """Drop numbers at the end, or add zeros."""
        self._values = (self._values + [0.0] * size)[:size]

    def __getitem__(self, index):
        self._check(index)
        return self._values[index]

    def __setitem__(self, index, value):
        self._check(index)
        self._values[index] = float(value)

    def _check(self, index):
        if not 0 <= index < len(self._values):
            raise IndexError("JntArray index out of range")

    def __eq__(self, other):
        return isinstance(other, JntArray) and self.is_close(other, EPSILON)

    def is_close(self, other, eps):
        """True if no two numbers differ by `eps` or more."""
        pairs = zip(self._values, other._values, strict=False)
        return self.rows() == other.rows() and all(abs(a - b) < eps for a, b in pairs)

    def __repr__(self):
        return "[" + "".join(text(value) for value in self._values) + "]"


class Jacobian:
    """The tip's velocity for a rate of 1 of each joint, as columns."""

    def __init__(self, size=0):
        """Zeros, or a copy."""
        self._columns = [Twist(each) for each in size._columns] if isinstance(size, Jacobian) else []
        if not isinstance(size, Jacobian):
            self.resize(size)

    def rows(self):
        """Six: linear and angular velocity."""
        return 6

    def columns(self):
        """Count of joints."""
        return len(self._columns)

    def resize(self, columns):
        """Drop columns at the end, or add zeros."""
        self._columns = [*self._columns, *(Twist() for _ in range(columns))][:columns]

    def __getitem__(self, at):
        row, column = at
        return self._columns[column][row]

    def __setitem__(self, at, value):
        row, column = at
        self._columns[column][row] = value

    def getColumn(self, i):
        """Velocity by one joint."""
        return Twist(self._columns[i])

    def setColumn(self, i, twist):
        """Set the velocity by one joint."""
        self._columns[i] = Twist(twist)

    def changeRefPoint(self, base):
        """Move the point whose velocity it is, in place."""
        self._columns = [column.RefPoint(Vector(base)) for column in self._columns]

    def changeBase(self, rot):
        """Turn into other axes, in place."""
        self._columns = [rot * column for column in self._columns]

    def changeRefFrame(self, frame):
        """Turn and move, in place."""
        self._columns = [frame * column for column in self._columns]


def Add(src1, src2, dest):
    """Write the sum of two JntArrays into a third."""
    dest._values = [a + b for a, b in zip(src1._values, src2._values, strict=True)]


def Subtract(src1, src2, dest):
    """Write the difference of two JntArrays into a third."""
    dest._values = [a - b for a, b in zip(src1._values, src2._values, strict=True)]


def Multiply(src, factor, dest):
    """Write a JntArray times a number into another."""
    dest._values = [value * factor for value in src._values]


def Divide(src, factor, dest):
    """Write a JntArray divided by a number into another."""
    dest._values = [value / factor for value in src._values]
