"""Differences of poses over time, scalar product and equality."""

from .frame import Frame
from .joint_arrays import JntArray
from .numbers import EPSILON
from .rotation import Rotation
from .screws import Twist, Wrench
from .vector import Vector

TYPE_CHECKING = False  # not from `typing`, whose import takes longer than this package's
if TYPE_CHECKING:
    from typing import Any


def diff(a: "Any", b: "Any", dt: float = 1.0) -> "Any":
    """Velocity from `a` to `b` in `dt` [s]: a Twist for Frames, a Vector for Rotations and Vectors."""
    if isinstance(a, Frame):
        return Twist(diff(a.p, b.p, dt), diff(a.M, b.M, dt))
    if isinstance(a, Rotation):
        return a * ((a.Inverse() * b).GetRot() / dt)
    return (b - a) / dt


def addDelta(a: "Any", da: "Any", dt: float = 1.0) -> "Any":
    """Pose that `a` reaches with the velocity `da` in `dt` [s]; the inverse of `diff`."""
    if isinstance(a, Frame):
        return Frame(addDelta(a.M, da.rot, dt), addDelta(a.p, da.vel, dt))
    if isinstance(a, Rotation):
        velocity = Vector(*da)
        return a * Rotation.Rot(a.Inverse(velocity), velocity.Norm() * dt)
    return a + da * dt


def dot(a: "Any", b: "Any") -> float:
    """Scalar product of two Vectors; power of a Twist and a Wrench."""
    if isinstance(a, Wrench):
        a, b = b, a
    if isinstance(a, Twist):
        return dot(a.vel, b.force) + dot(a.rot, b.torque)
    return sum(x * y for x, y in zip(a, b, strict=True))


def Equal(a: "Any", b: "Any", eps: float = EPSILON) -> bool:
    """True if no two numbers differ by `eps` or more."""
    return a.is_close(b, eps)


def SetToZero(value: "Vector | Twist | Wrench | JntArray") -> None:
    """Set a Vector, Twist, Wrench or JntArray to zero, in place."""
    for index in range(value.rows() if isinstance(value, JntArray) else value.size):
        value[index] = 0.0
