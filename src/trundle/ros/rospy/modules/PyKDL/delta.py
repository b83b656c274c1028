"""Differences of poses over time, and what two values have in common."""

from .frame import Frame
from .joint_arrays import JntArray
from .numbers import EPSILON
from .rotation import Rotation
from .screws import Twist, Wrench
from .vector import Vector


def diff(a, b, dt=1.0):
    """Velocity that brings `a` to `b` in `dt` [s]: a Twist for Frames, a Vector for Rotations and Vectors."""
    if isinstance(a, Frame):
        return Twist(diff(a.p, b.p, dt), diff(a.M, b.M, dt))
    if isinstance(a, Rotation):
        return a * ((a.Inverse() * b).GetRot() / dt)
    return (b - a) / dt


def addDelta(a, da, dt=1.0):
    """Pose that the velocity `da` brings `a` to in `dt` [s]; the inverse of `diff`."""
    if isinstance(a, Frame):
        return Frame(addDelta(a.M, da.rot, dt), addDelta(a.p, da.vel, dt))
    if isinstance(a, Rotation):
        velocity = Vector(*da)
        return a * Rotation.Rot(a.Inverse(velocity), velocity.Norm() * dt)
    return a + da * dt


def dot(a, b):
    """Scalar product of two Vectors; power of a Twist and a Wrench."""
    if isinstance(a, Wrench):
        a, b = b, a
    if isinstance(a, Twist):
        return dot(a.vel, b.force) + dot(a.rot, b.torque)
    return sum(x * y for x, y in zip(a, b, strict=True))


def Equal(a, b, eps=EPSILON):
    """True if no two numbers differ by `eps` or more."""
    return a.is_close(b, eps)


def SetToZero(value):
    """Set a Vector, Twist, Wrench or JntArray to zero, in place."""
    for index in range(value.rows() if isinstance(value, JntArray) else value.size):
        value[index] = 0.0
