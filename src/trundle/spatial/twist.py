"""Velocities of rigid bodies."""

from msgspec import Struct

from .vectors import ZERO, Vector3


class Twist(Struct, frozen=True):
    """Velocity of a point of a body and angular velocity of the body, in one frame."""

    linear: Vector3 = ZERO
    """[m/s]"""
    angular: Vector3 = ZERO
    """[rad/s]"""

    def as_list(self) -> list[float]:
        """Return [vx, vy, vz, wx, wy, wz]."""
        return [*self.linear, *self.angular]
