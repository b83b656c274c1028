"""Pose of a frame in its parent."""

from collections.abc import Iterable

from .numbers import EPSILON
from .rotation import Rotation
from .screws import Twist
from .vector import Vector

TYPE_CHECKING = False  # not from `typing`, whose import takes longer than this package's
if TYPE_CHECKING:
    from typing import Any


class Frame:
    """Rotation `M` and origin `p`."""

    __slots__ = ("_origin", "_rotation")
    __hash__ = None  # pyright: ignore[reportAssignmentType]

    def __init__(self, R: object = None, V: object = None) -> None:
        """The identity, a Rotation, a Vector, both, or a copy."""
        if isinstance(R, Frame) and V is None:
            self._rotation, self._origin = Rotation(R.M), Vector(R.p)
        elif isinstance(R, Vector) and V is None:
            self._rotation, self._origin = Rotation(), Vector(*R)
        elif (R is None or isinstance(R, Rotation)) and (V is None or isinstance(V, Vector)):
            self._rotation = Rotation() if R is None else Rotation(R)
            self._origin = Vector() if V is None else Vector(*V)
        else:
            raise TypeError(f"Frame takes a Rotation, a Vector, both, a Frame or nothing, not ({R!r}, {V!r})")

    @property
    def M(self) -> Rotation:
        """Rotation."""
        return self._rotation

    @M.setter
    def M(self, rotation: Rotation) -> None:
        self._rotation = Rotation(rotation)

    @property
    def p(self) -> Vector:
        """Origin."""
        return self._origin

    @p.setter
    def p(self, vector: Iterable[float]) -> None:
        self._origin = Vector(*vector)

    @staticmethod
    def Identity() -> "Frame":
        """Frame that equals its parent."""
        return Frame()

    @staticmethod
    def DH(a: float, alpha: float, d: float, theta: float) -> "Frame":
        """Frame of Denavit and Hartenberg's parameters: z by d and theta, then x by a and alpha."""
        turned = Rotation.RotZ(theta)
        return Frame(turned * Rotation.RotX(alpha), turned * Vector(a, 0, d))

    @staticmethod
    def DH_Craig1989(a: float, alpha: float, d: float, theta: float) -> "Frame":
        """Frame of Craig's parameters: x by a and alpha, then z by d and theta."""
        tilted = Rotation.RotX(alpha)
        return Frame(tilted * Rotation.RotZ(theta), tilted * Vector(0, 0, d) + Vector(a, 0, 0))

    def __mul__(self, other: "Any") -> "Any":
        if isinstance(other, Frame):
            return Frame(self.M * other.M, self.M * other.p + self.p)
        if isinstance(other, Vector):
            return self.M * other + self.p
        return other._moved(self.M, self.p) if hasattr(other, "_moved") else NotImplemented

    def Inverse(self, argument: "Any" = None) -> "Any":
        """Inverse; or the inverse times a Vector, Twist or Wrench."""
        back = self.M.Inverse()
        inverse = Frame(back, -(back * self.p))
        return inverse if argument is None else inverse * argument

    def Integrate(self, t_this: Twist, frequency: float) -> None:
        """Move in place by a Twist in its own axes, for 1/frequency [s]."""
        step: Twist = t_this
        angle = step.rot.Norm() / frequency
        if angle < EPSILON:
            self._origin = self.p + self.M * (step.vel / frequency)
        else:
            moved = self * Frame(Rotation.Rot(Vector(*step.rot), angle), step.vel / frequency)
            self._rotation, self._origin = moved.M, moved.p

    def __getitem__(self, index: tuple[int, int]) -> float:
        row, column = self._check(index)
        return self.p[row] if column == 3 else self.M[row, column]

    def __setitem__(self, index: tuple[int, int], value: float) -> None:
        row, column = self._check(index)
        if column == 3:
            self.p[row] = value
        else:
            self.M[row, column] = value

    @staticmethod
    def _check(index: tuple[int, int]) -> tuple[int, int]:
        row, column = index
        if not (0 <= row < 3 and 0 <= column < 4):
            raise IndexError("Frame index out of range")
        return row, column

    def is_close(self, other: "Frame", eps: float) -> bool:
        """True if no two numbers differ by `eps` or more."""
        return self.M.is_close(other.M, eps) and self.p.is_close(other.p, eps)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Frame) and self.is_close(other, EPSILON)

    def __copy__(self) -> "Frame":
        return Frame(self)

    def __deepcopy__(self, memo: object) -> "Frame":
        return Frame(self)

    def __reduce__(self) -> tuple[object, ...]:
        return Frame, (self.M, self.p)

    def __repr__(self) -> str:
        return f"[{self.M}\n{self.p}]"
