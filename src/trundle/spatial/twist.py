"""Velocities of rigid bodies."""

from msgspec import Struct
from msgspec.structs import force_setattr

from .vectors import ZERO, Vector3, numbers_of


class Twist(Struct, frozen=True):
    """Velocity of a point of a body and angular velocity of the body, in one frame.

    Both may be lists and arrays, too; they become tuples.

    Raises:
        ValueError: one of them is not 3 numbers.
    """

    __module__ = "trundle"

    linear: Vector3 = ZERO
    """[m/s]"""
    angular: Vector3 = ZERO
    """[rad/s]"""

    def __post_init__(self) -> None:
        first, second = self.linear, self.angular
        if first.__class__ is tuple and len(first) == 3 and second.__class__ is tuple and len(second) == 3:
            return
        problem = "a Twist's linear and angular velocity must have 3 numbers (x, y, z) each [m/s, rad/s]"
        force_setattr(self, "linear", numbers_of(first, (3,), problem))
        force_setattr(self, "angular", numbers_of(second, (3,), problem))

    def as_list(self) -> list[float]:
        """Return [vx, vy, vz, wx, wy, wz]."""
        return [*self.linear, *self.angular]
