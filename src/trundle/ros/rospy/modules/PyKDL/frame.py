"""Pose of a frame in its parent."""

from .numbers import EPSILON
from .rotation import Rotation
from .screws import Twist
from .vector import Vector


class Frame:
    """Rotation `M` and origin `p`."""

    __slots__ = ("_M", "_p")
    __hash__ = None

    def __init__(self, R=None, V=None):
        """The identity, a Rotation, a Vector, both, or a copy."""
        if isinstance(R, Frame) and V is None:
            self._M, self._p = Rotation(R.M), Vector(R.p)
        elif isinstance(R, Vector) and V is None:
            self._M, self._p = Rotation(), Vector(*R)
        elif (R is None or isinstance(R, Rotation)) and (V is None or isinstance(V, Vector)):
            self._M = Rotation() if R is None else Rotation(R)
            self._p = Vector() if V is None else Vector(*V)
        else:
            raise TypeError(f"Frame takes a Rotation, a Vector, both, a Frame or nothing, not ({R!r}, {V!r})")

    @property
    def M(self):
        """Rotation."""
        return self._M

    @M.setter
    def M(self, rotation):
        self._M = Rotation(rotation)

    @property
    def p(self):
        """Origin."""
        return self._p

    @p.setter
    def p(self, vector):
        self._p = Vector(*vector)

    @staticmethod
    def Identity():
        """The parent itself."""
        return Frame()

    @staticmethod
    def DH(a, alpha, d, theta):
        """Frame of Denavit and Hartenberg's parameters: z by d and theta, then x by a and alpha."""
        turned = Rotation.RotZ(theta)
        return Frame(turned * Rotation.RotX(alpha), turned * Vector(a, 0, d))

    @staticmethod
    def DH_Craig1989(a, alpha, d, theta):
        """Frame of Craig's parameters: x by a and alpha, then z by d and theta."""
        tilted = Rotation.RotX(alpha)
        return Frame(tilted * Rotation.RotZ(theta), tilted * Vector(0, 0, d) + Vector(a, 0, 0))

    def __mul__(self, other):
        if isinstance(other, Frame):
            return Frame(self.M * other.M, self.M * other.p + self.p)
        if isinstance(other, Vector):
            return self.M * other + self.p
        return other._moved(self) if hasattr(other, "_moved") else NotImplemented

    def Inverse(self, argument=None):
        """Inverse; or the inverse times a Vector, Twist or Wrench."""
        back = self.M.Inverse()
        inverse = Frame(back, -(back * self.p))
        return inverse if argument is None else inverse * argument

    def Integrate(self, t_this, frequency):
        """Move in place by a Twist in its own axes, for 1/frequency [s]."""
        step: Twist = t_this
        angle = step.rot.Norm() / frequency
        if angle < EPSILON:
            self._p = self.p + self.M * (step.vel / frequency)
        else:
            moved = self * Frame(Rotation.Rot(Vector(*step.rot), angle), step.vel / frequency)
            self._M, self._p = moved.M, moved.p

    def __getitem__(self, index):
        row, column = self._check(index)
        return self.p[row] if column == 3 else self.M[row, column]

    def __setitem__(self, index, value):
        row, column = self._check(index)
        if column == 3:
            self.p[row] = value
        else:
            self.M[row, column] = value

    @staticmethod
    def _check(index):
        row, column = index
        if not (0 <= row < 3 and 0 <= column < 4):
            raise IndexError("Frame index out of range")
        return row, column

    def is_close(self, other, eps):
        """True if no two numbers differ by `eps` or more."""
        return self.M.is_close(other.M, eps) and self.p.is_close(other.p, eps)

    def __eq__(self, other):
        return isinstance(other, Frame) and self.is_close(other, EPSILON)

    def __copy__(self):
        return Frame(self)

    def __deepcopy__(self, memo):
        return Frame(self)

    def __reduce__(self):
        return Frame, (self.M, self.p)

    def __repr__(self):
        return f"[{self.M}\n{self.p}]"
