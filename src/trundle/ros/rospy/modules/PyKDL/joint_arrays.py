"""Values of a chain's joints, and their effect on its tip."""

from .frame import Frame
from .numbers import EPSILON, text
from .rotation import Rotation
from .screws import Twist
from .vector import Vector


class JntArray:
    """A number for each joint."""

    __hash__ = None  # pyright: ignore[reportAssignmentType]

    def __init__(self, size: "int | JntArray" = 0) -> None:
        """Zeros, or a copy."""
        if not isinstance(size, int | JntArray):  # pyright: ignore[reportUnnecessaryIsInstance]
            raise TypeError(f"JntArray takes a size or a JntArray, not {size!r}")
        self._values = list(size._values) if isinstance(size, JntArray) else [0.0] * size

    def rows(self) -> int:
        """Count of numbers."""
        return len(self._values)

    def columns(self) -> int:
        """One, as a column of a matrix."""
        return 1

    def resize(self, size: int) -> None:
        """Drop numbers at the end, or add zeros."""
        self._values = (self._values + [0.0] * size)[:size]

    def __getitem__(self, index: int) -> float:
        self._check(index)
        return self._values[index]

    def __setitem__(self, index: int, value: float) -> None:
        self._check(index)
        self._values[index] = float(value)

    def _check(self, index: int) -> None:
        if not 0 <= index < len(self._values):
            raise IndexError("JntArray index out of range")

    def __eq__(self, other: object) -> bool:
        return isinstance(other, JntArray) and self.is_close(other, EPSILON)

    def is_close(self, other: "JntArray", eps: float) -> bool:
        """True if no two numbers differ by `eps` or more."""
        pairs = zip(self._values, other._values, strict=False)
        return self.rows() == other.rows() and all(abs(a - b) < eps for a, b in pairs)

    def __repr__(self) -> str:
        return "[" + "".join(text(value) for value in self._values) + "]"


class Jacobian:
    """The tip's velocity for a rate of 1 of each joint, as columns."""

    def __init__(self, size: "int | Jacobian" = 0) -> None:
        """Zeros, or a copy."""
        self._columns = [Twist(column) for column in size._columns] if isinstance(size, Jacobian) else []
        if not isinstance(size, Jacobian):
            self.resize(size)

    def rows(self) -> int:
        """Six: linear and angular velocity."""
        return 6

    def columns(self) -> int:
        """Count of joints."""
        return len(self._columns)

    def resize(self, columns: int) -> None:
        """Drop columns at the end, or add zeros."""
        self._columns = [*self._columns, *(Twist() for _ in range(columns))][:columns]

    def __getitem__(self, index: tuple[int, int]) -> float:
        row, column = index
        return self._columns[column][row]

    def __setitem__(self, index: tuple[int, int], value: float) -> None:
        row, column = index
        self._columns[column][row] = value

    def getColumn(self, i: int) -> Twist:
        """Velocity by one joint."""
        return Twist(self._columns[i])

    def setColumn(self, i: int, twist: Twist) -> None:
        """Set the velocity by one joint."""
        self._columns[i] = Twist(twist)

    def changeRefPoint(self, base: Vector) -> None:
        """Shift the point of reference, in place."""
        self._columns = [column.RefPoint(Vector(base)) for column in self._columns]

    def changeBase(self, rot: Rotation) -> None:
        """Rotate into other axes, in place."""
        self._columns = [rot * column for column in self._columns]

    def changeRefFrame(self, frame: Frame) -> None:
        """Transform into another frame, in place."""
        self._columns = [frame * column for column in self._columns]


def Add(src1: JntArray, src2: JntArray, dest: JntArray) -> None:
    """Write the sum of two JntArrays into a third."""
    dest._values = [a + b for a, b in zip(src1._values, src2._values, strict=True)]


def Subtract(src1: JntArray, src2: JntArray, dest: JntArray) -> None:
    """Write the difference of two JntArrays into a third."""
    dest._values = [a - b for a, b in zip(src1._values, src2._values, strict=True)]


def Multiply(src: JntArray, factor: float, dest: JntArray) -> None:
    """Write a JntArray times a number into another."""
    dest._values = [value * factor for value in src._values]


def Divide(src: JntArray, factor: float, dest: JntArray) -> None:
    """Write a JntArray divided by a number into another."""
    dest._values = [value / factor for value in src._values]
