"""Poses in messages."""

import math
from collections.abc import Iterable
from typing import Any

from trundle.spatial import Pose, Vector3

_MAX_M = 1e9
"""Beyond it the squares and products of positions overflow, or lose all digits."""
_MIN_NORM = 1e-9
PlanarPose = tuple[float, float, float]
"""x, y [m], yaw [rad]."""


def read_pose(message: Any) -> Pose:
    """Convert a geometry_msgs/Pose.

    Raises:
        ValueError: a number is not finite, a position is beyond 1e9 m, or the orientation is all zeros.
    """
    position: Vector3 = (message.position.x, message.position.y, message.position.z)
    q = message.orientation
    norm = math.hypot(q.w, q.x, q.y, q.z)
    if not math.isfinite(norm) or norm < _MIN_NORM or not is_place(position):
        raise ValueError("the pose has numbers that are not finite or beyond 1e9 m, or an orientation of zeros")
    return Pose(position, (q.w / norm, q.x / norm, q.y / norm, q.z / norm))


def is_place(position: Iterable[float]) -> bool:
    """True if all coordinates are finite and within 1e9 m."""
    return all(abs(value) <= _MAX_M for value in position)


def pose_fields(pose: Pose) -> dict[str, Any]:
    """Return the fields of a geometry_msgs/Pose."""
    (x, y, z), (qw, qx, qy, qz) = pose.position, pose.quaternion
    return {"position": {"x": x, "y": y, "z": z}, "orientation": {"w": qw, "x": qx, "y": qy, "z": qz}}


def planar(pose: Pose) -> PlanarPose:
    """Project a pose onto the ground."""
    return pose.position[0], pose.position[1], pose.rpy[2]


def from_planar(x: float, y: float, yaw: float) -> Pose:
    """Return the pose on the ground."""
    return Pose((x, y, 0.0), (math.cos(yaw / 2.0), 0.0, 0.0, math.sin(yaw / 2.0)))
