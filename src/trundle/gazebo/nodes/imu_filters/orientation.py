"""Orientation of an imu from gravity and the magnetic field at one time."""

import math

import numpy as np

from trundle.spatial import (
    Quaternion,
    Vector3,
    conjugate,
    cross,
    multiply,
    normalized,
    quaternion_from_matrix,
    rotation_from_z,
)

_MIN_HORIZONTAL = 1e-7
"""Length of (field × gravity) below which there is no north: near the pole, or in free fall [T m/s²]."""
_MIN_GRAVITY = 0.1
"""[m/s²]"""
UP = {"enu": (0.0, 0.0, 1.0), "nwu": (0.0, 0.0, 1.0), "ned": (0.0, 0.0, -1.0)}
"""World frame → upward direction, which an accelerometer at rest measures."""


def orientation_from_gravity(acceleration: Vector3, frame: str) -> Quaternion | None:
    """Return world_from_imu with any heading; None in free fall. An imu that lies flat has heading 0 in enu."""
    x, y, z = acceleration
    if max(abs(x), abs(y)) > _MIN_GRAVITY:
        return orientation_from_field(acceleration, (y, x, 0.0), frame)
    if abs(z) > _MIN_GRAVITY:
        return orientation_from_field(acceleration, (0.0, z, y), frame)
    return None


def orientation_from_field(acceleration: Vector3, field: Vector3, frame: str) -> Quaternion | None:
    """Return world_from_imu; None where gravity and the field are parallel or missing.

    Args:
        acceleration: measured by the imu [m/s²].
        field: magnetic field in the imu's frame, of any unit.
        frame: world frame: 'enu', 'ned' or 'nwu'.
    """
    east, up = cross(field, acceleration), normalized(acceleration)
    if up is None or not math.hypot(*east) >= _MIN_HORIZONTAL:
        return None
    east = multiply(east, 1.0 / math.hypot(*east))
    north = cross(up, east)
    west, down = multiply(east, -1.0), multiply(up, -1.0)
    rows = {"enu": (east, north, up), "ned": (north, east, down), "nwu": (north, west, up)}[frame]
    return quaternion_from_matrix(np.array(rows))


def rotation_to_z(direction: Vector3) -> Quaternion:
    """Return the shortest rotation from a unit vector to +z."""
    return conjugate(rotation_from_z(direction))
