"""Forces and torques on rigid bodies."""

from msgspec import Struct

from .vectors import ZERO, Vector3, add


class Wrench(Struct, frozen=True):
    """Force at a point and torque, in one frame."""

    force: Vector3 = ZERO
    """[N]"""
    torque: Vector3 = ZERO
    """[N·m]"""

    def __add__(self, other: "Wrench") -> "Wrench":
        """Return the sum of two wrenches at the same point."""
        return Wrench(add(self.force, other.force), add(self.torque, other.torque))
