"""Rigid transforms."""

from typing import Self

from msgspec import Struct
from msgspec.structs import force_setattr

from .quaternions import (
    IDENTITY_QUATERNION,
    Quaternion,
    conjugate,
    quaternion_from_rpy,
    quaternion_product,
    rotate,
    rpy_from_quaternion,
)
from .vectors import ZERO, Vector3, numbers_of


class Pose(Struct, frozen=True):
    """Rigid transform `a_from_b`: origin and axes of frame b, expressed in frame a.

    Position and quaternion may be lists and arrays, too; they become tuples.

    Raises:
        ValueError: the position is not 3 numbers, or the quaternion not 4.
    """

    __module__ = "trundle"

    position: Vector3 = ZERO
    """[m]"""
    quaternion: Quaternion = IDENTITY_QUATERNION
    """(w, x, y, z), unit."""

    def __post_init__(self) -> None:
        p, q = self.position, self.quaternion
        if p.__class__ is tuple and len(p) == 3 and q.__class__ is tuple and len(q) == 4:
            return
        force_setattr(self, "position", numbers_of(p, (3,), "a Pose's position must be 3 numbers (x, y, z) [m]"))
        force_setattr(self, "quaternion", numbers_of(q, (4,), "a Pose's quaternion must be 4 numbers (w, x, y, z)"))

    @classmethod
    def from_rpy(cls, x: float, y: float, z: float, roll: float = 0.0, pitch: float = 0.0, yaw: float = 0.0) -> Self:
        """Make a pose of a position [m] and fixed-axis roll, pitch, yaw [rad], as in an SDF <pose>."""
        return cls((x, y, z), quaternion_from_rpy(roll, pitch, yaw))

    def __matmul__(self, other: "Pose") -> "Pose":
        """`a_from_b @ b_from_c` is `a_from_c`."""
        x, y, z = rotate(self.quaternion, other.position)
        px, py, pz = self.position
        return Pose((px + x, py + y, pz + z), quaternion_product(self.quaternion, other.quaternion))

    def inverse(self) -> "Pose":
        """`a_from_b.inverse()` is `b_from_a`."""
        inverse = conjugate(self.quaternion)
        px, py, pz = rotate(inverse, self.position)
        return Pose((-px, -py, -pz), inverse)

    def transform_point(self, p: Vector3) -> Vector3:
        """Express a point given in frame b in frame a [m]."""
        x, y, z = rotate(self.quaternion, p)
        return (self.position[0] + x, self.position[1] + y, self.position[2] + z)

    def transform_vector(self, v: Vector3) -> Vector3:
        """Express a free vector given in frame b in frame a, in the same unit."""
        return rotate(self.quaternion, v)

    @property
    def rpy(self) -> Vector3:
        """Roll, pitch, yaw about fixed axes [rad]."""
        return rpy_from_quaternion(self.quaternion)

    def as_list(self) -> list[float]:
        """Return x, y, z [m], roll, pitch, yaw [rad], as in SDF and `--json`."""
        return [*self.position, *self.rpy]
