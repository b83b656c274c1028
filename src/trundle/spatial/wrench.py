"""Forces and torques on rigid bodies."""

from msgspec import Struct
from msgspec.structs import force_setattr

from .vectors import ZERO, Vector3, add, numbers_of


class Wrench(Struct, frozen=True):
    """Force at a point and torque, in one frame.

    Both may be lists and arrays, too; they become tuples.

    Raises:
        ValueError: one of them is not 3 numbers.
    """

    __module__ = "trundle"

    force: Vector3 = ZERO
    """[N]"""
    torque: Vector3 = ZERO
    """[N·m]"""

    def __post_init__(self) -> None:
        first, second = self.force, self.torque
        if first.__class__ is tuple and len(first) == 3 and second.__class__ is tuple and len(second) == 3:
            return
        problem = "a Wrench's force and torque must have 3 numbers (x, y, z) each [N, N·m]"
        force_setattr(self, "force", numbers_of(first, (3,), problem))
        force_setattr(self, "torque", numbers_of(second, (3,), problem))

    def __add__(self, other: "Wrench") -> "Wrench":
        """Return the sum of two wrenches at the same point."""
        return Wrench(add(self.force, other.force), add(self.torque, other.torque))
