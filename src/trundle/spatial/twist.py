"""Velocities of rigid bodies."""

from msgspec import Struct

from .vectors import ZERO, Vector3


class Twist(Struct, frozen=True):
    """Velocity of a point of a body and of the body's rotation, in one stated frame."""

    linear: Vector3 = ZERO
    """[m/s]"""
    angular: Vector3 = ZERO
    """[rad/s]"""

    def as_list(self) -> list[float]:
        """[vx, vy, vz, wx, wy, wz]."""
        return [*self.linear, *self.angular]
