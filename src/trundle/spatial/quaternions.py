"""Rotations as unit quaternions (w, x, y, z), as tuples."""

import math
from typing import TypeAlias

from .vectors import Vector3

Quaternion: TypeAlias = tuple[float, float, float, float]
"""(w, x, y, z), unit."""

IDENTITY_QUATERNION: Quaternion = (1.0, 0.0, 0.0, 0.0)
_POLE = 1e-10
"""Cosine of the pitch below which roll and yaw are about the same axis."""
_SAME_RAD = 1e-9
"""Largest half angle between rotations that are treated as equal."""


def quaternion_from_rpy(roll: float, pitch: float, yaw: float) -> Quaternion:
    """Rotate about the fixed x, then y, then z axis [rad], as in SDF and URDF."""
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

    Roll is the remaining rotation after undoing yaw and pitch: near the pole only their sum is exact.
    """
    w, x, y, z = q
    r00, r10 = 1 - 2 * (y * y + z * z), 2 * (x * y + w * z)
    cos_pitch = math.hypot(r00, r10)
    pitch = math.atan2(2 * (w * y - z * x), cos_pitch)
    yaw = math.atan2(r10, r00) if cos_pitch > _POLE else 0.0
    without_yaw = quaternion_product((math.cos(yaw / 2), 0.0, 0.0, -math.sin(yaw / 2)), q)
    rest = quaternion_product((math.cos(pitch / 2), 0.0, -math.sin(pitch / 2), 0.0), without_yaw)
    return (math.remainder(2 * math.atan2(rest[1], rest[0]), math.tau), pitch, yaw)


def quaternion_from_axis_angle(axis: Vector3, angle: float) -> Quaternion:
    """Rotate about a unit axis by an angle [rad]."""
    s = math.sin(angle / 2)
    return (math.cos(angle / 2), axis[0] * s, axis[1] * s, axis[2] * s)


def rotation_from_z(normal: Vector3) -> Quaternion:
    """Return the shortest rotation from +z to a unit vector."""
    x, y, z = normal
    if z < -1 + 1e-12:
        return (0.0, 1.0, 0.0, 0.0)
    if z > 1 - 1e-12:
        return IDENTITY_QUATERNION
    w = math.sqrt((1 + z) / 2)
    return (w, -y / (2 * w), x / (2 * w), 0.0)


def quaternion_product(a: Quaternion, b: Quaternion) -> Quaternion:
    """Return the Hamilton product: rotation by b, then by a."""
    aw, ax, ay, az = a
    bw, bx, by, bz = b
    return (
        aw * bw - ax * bx - ay * by - az * bz,
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
    )


def conjugate(q: Quaternion) -> Quaternion:
    """Return the inverse rotation."""
    return (q[0], -q[1], -q[2], -q[3])


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


def rotated_axes(q: Quaternion) -> tuple[Vector3, Vector3, Vector3]:
    """Return `rotate` of the three unit axes, bit-identical and more than twice as fast."""
    w, x, y, z = q
    x2, y2, z2 = 2 * x, 2 * y, 2 * z
    return (
        (1.0 - y * y2 - z * z2, 0.0 + w * z2 + x * y2, 0.0 - w * y2 + x * z2),
        (0.0 - w * z2 + y * x2, 1.0 - z * z2 - x * x2, 0.0 + w * x2 + y * z2),
        (0.0 + w * y2 + z * x2, 0.0 - w * x2 + z * y2, 1.0 - x * x2 - y * y2),
    )


def slerp(a: Quaternion, b: Quaternion, ratio: float) -> Quaternion:
    """Interpolate from a to b along the shortest arc; `ratio` 0 gives a, 1 gives b up to its sign."""
    cosine = sum(p * q for p, q in zip(a, b, strict=True))
    if cosine < 0.0:
        b, cosine = (-b[0], -b[1], -b[2], -b[3]), -cosine
    angle = math.acos(min(cosine, 1.0))
    if angle < _SAME_RAD:
        return a
    weight_a, weight_b = math.sin((1 - ratio) * angle) / math.sin(angle), math.sin(ratio * angle) / math.sin(angle)
    w, x, y, z = (weight_a * p + weight_b * q for p, q in zip(a, b, strict=True))
    return (w, x, y, z)
