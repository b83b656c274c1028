"""Poses, twists and wrenches: rigid-body quantities as small immutable values.

Pure Python: a model holds a few hundred of them, and nothing here runs at every physics step.
"""

import math
from typing import Self, TypeAlias

from msgspec import Struct

Vector3: TypeAlias = tuple[float, float, float]
Quaternion: TypeAlias = tuple[float, float, float, float]
"""(w, x, y, z), unit."""

IDENTITY_QUATERNION: Quaternion = (1.0, 0.0, 0.0, 0.0)
ZERO: Vector3 = (0.0, 0.0, 0.0)
_POLE = 1e-10
"""Cosine of a pitch at which roll and yaw turn about the same axis."""


def quaternion_from_rpy(roll: float, pitch: float, yaw: float) -> Quaternion:
    """Rotate about the fixed x, then y, then z axis [rad], as SDF and URDF write rotations."""
    cr, sr = math.cos(roll / 2), math.sin(roll / 2)
    cp, sp = math.cos(pitch / 2), math.sin(pitch / 2)
    cy, sy = math.cos(yaw / 2), math.sin(yaw / 2)
    return (
        cr * cp * cy + sr * sp * sy,
        sr * cp * cy - cr * sp * sy,
        cr * sp * cy + sr * cp * sy,
        cr * cp * sy - sr * sp * cy,
    )


def rpy_from_quaternion(q: Quaternion) -> Vector3:
    """Return roll, pitch, yaw [rad]; within 1e-10 of pitch ±π/2, where they are not unique, yaw is 0.

    Roll is what is left when yaw and pitch are undone: near the pole neither is exact by itself, their sum is.
    """
    w, x, y, z = q
    r00, r10 = 1 - 2 * (y * y + z * z), 2 * (x * y + w * z)
    cos_pitch = math.hypot(r00, r10)
    pitch = math.atan2(2 * (w * y - z * x), cos_pitch)
    yaw = math.atan2(r10, r00) if cos_pitch > _POLE else 0.0
    without_yaw = quaternion_product((math.cos(yaw / 2), 0.0, 0.0, -math.sin(yaw / 2)), q)
    rest = quaternion_product((math.cos(pitch / 2), 0.0, -math.sin(pitch / 2), 0.0), without_yaw)
    return (math.remainder(2 * math.atan2(rest[1], rest[0]), math.tau), pitch, yaw)


def normalized(v: Vector3) -> Vector3 | None:
    """Return v at length one, or None where its length is zero or not finite."""
    length = math.hypot(*v)
    if not 0.0 < length < math.inf:
        return None
    return (v[0] / length, v[1] / length, v[2] / length)


def cross(a: Vector3, b: Vector3) -> Vector3:
    """The cross product a × b."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def quaternion_product(a: Quaternion, b: Quaternion) -> Quaternion:
    """Hamilton product: first b, then a."""
    aw, ax, ay, az = a
    bw, bx, by, bz = b
    return (
        aw * bw - ax * bx - ay * by - az * bz,
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
    )


def rotate(q: Quaternion, v: Vector3) -> Vector3:
    """Rotate a vector by a unit quaternion: v + 2w(u × v) + 2u × (u × v)."""
    w, ux, uy, uz = q
    tx = 2 * (uy * v[2] - uz * v[1])
    ty = 2 * (uz * v[0] - ux * v[2])
    tz = 2 * (ux * v[1] - uy * v[0])
    return (
        v[0] + w * tx + uy * tz - uz * ty,
        v[1] + w * ty + uz * tx - ux * tz,
        v[2] + w * tz + ux * ty - uy * tx,
    )


def rotation_from_z(normal: Vector3) -> Quaternion:
    """The shortest rotation that takes +z to a unit vector."""
    x, y, z = normal
    if z < -1 + 1e-12:
        return (0.0, 1.0, 0.0, 0.0)
    if z > 1 - 1e-12:
        return IDENTITY_QUATERNION
    w = math.sqrt((1 + z) / 2)
    return (w, -y / (2 * w), x / (2 * w), 0.0)


class Pose(Struct, frozen=True):
    """A rigid transform `a_from_b`: where frame b's origin and axes are, seen from frame a."""

    position: Vector3 = ZERO
    """[m]"""
    quaternion: Quaternion = IDENTITY_QUATERNION
    """(w, x, y, z), unit."""

    @classmethod
    def from_rpy(cls, x: float, y: float, z: float, roll: float = 0.0, pitch: float = 0.0, yaw: float = 0.0) -> Self:
        """Position [m] and fixed-axis roll, pitch, yaw [rad], the six numbers of an SDF pose."""
        return cls((x, y, z), quaternion_from_rpy(roll, pitch, yaw))

    def __matmul__(self, other: "Pose") -> "Pose":
        """`a_from_b @ b_from_c` is `a_from_c`."""
        x, y, z = rotate(self.quaternion, other.position)
        px, py, pz = self.position
        return Pose((px + x, py + y, pz + z), quaternion_product(self.quaternion, other.quaternion))

    def inverse(self) -> "Pose":
        """`a_from_b.inverse()` is `b_from_a`."""
        w, x, y, z = self.quaternion
        conjugate = (w, -x, -y, -z)
        px, py, pz = rotate(conjugate, self.position)
        return Pose((-px, -py, -pz), conjugate)

    def transform_point(self, p: Vector3) -> Vector3:
        """Express a point given in frame b in frame a [m]."""
        x, y, z = rotate(self.quaternion, p)
        return (self.position[0] + x, self.position[1] + y, self.position[2] + z)

    def transform_vector(self, v: Vector3) -> Vector3:
        """Express a free vector given in frame b in frame a."""
        return rotate(self.quaternion, v)

    @property
    def rpy(self) -> Vector3:
        """Roll, pitch, yaw about fixed axes [rad]."""
        return rpy_from_quaternion(self.quaternion)

    def as_list(self) -> list[float]:
        """[x, y, z, roll, pitch, yaw] [m, rad], as SDF and `--json` write a pose."""
        return [*self.position, *self.rpy]


class Twist(Struct, frozen=True):
    """Velocity of a point of a body and of the body's rotation, in one stated frame."""

    linear: Vector3 = ZERO
    """[m/s]"""
    angular: Vector3 = ZERO
    """[rad/s]"""

    def as_list(self) -> list[float]:
        """[vx, vy, vz, wx, wy, wz]."""
        return [*self.linear, *self.angular]


class Wrench(Struct, frozen=True):
    """Force at a point and torque, in one stated frame."""

    force: Vector3 = ZERO
    """[N]"""
    torque: Vector3 = ZERO
    """[N·m]"""

    def __add__(self, other: "Wrench") -> "Wrench":
        """Both at once, at one point."""
        (fx, fy, fz), (tx, ty, tz) = other.force, other.torque
        force, torque = self.force, self.torque
        return Wrench((force[0] + fx, force[1] + fy, force[2] + fz), (torque[0] + tx, torque[1] + ty, torque[2] + tz))
