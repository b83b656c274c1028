"""Sensors of robot_pose_ekf, and the measurements in their messages."""

import math
from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from trundle.spatial import Pose, slerp

_Array = NDArray[np.float64]
MAX_VARIANCE = 1e9
_BUFFER = 200


@dataclass(slots=True)
class Sensor:
    """Poses of a sensor's frame over time."""

    name: str
    topic: str
    kind: str
    indices: tuple[int, ...]
    """Measured elements of x, y, z, roll, pitch, yaw."""
    poses: deque[tuple[int, Pose]] = field(default_factory=lambda: deque[tuple[int, Pose]](maxlen=_BUFFER))
    """Stamps [ns] and poses."""
    covariance: _Array = field(default_factory=lambda: np.eye(1))
    received_ns: int | None = None
    count: int = 0
    last: Pose | None = None
    """Pose at the last step; None: the sensor was not used yet."""

    def at(self, stamp_ns: int) -> Pose | None:
        """Interpolate between the messages before and after a time; None outside the messages."""
        before: tuple[int, Pose] | None = None
        for stamp, pose in self.poses:
            if stamp == stamp_ns:
                return pose
            if stamp > stamp_ns:
                return None if before is None else _interpolated(before, (stamp, pose), stamp_ns)
            before = (stamp, pose)
        return None


def _interpolated(a: tuple[int, Pose], b: tuple[int, Pose], stamp_ns: int) -> Pose:
    ratio = (stamp_ns - a[0]) / (b[0] - a[0])
    x, y, z = (p + ratio * (q - p) for p, q in zip(a[1].position, b[1].position, strict=True))
    return Pose((x, y, z), slerp(a[1].quaternion, b[1].quaternion, ratio))


SENSORS = {
    "odom": ("odom", "nav_msgs/Odometry", (0, 1, 5)),
    "imu": ("imu_data", "sensor_msgs/Imu", (3, 4, 5)),
    "vo": ("vo", "nav_msgs/Odometry", (0, 1, 2, 3, 4, 5)),
    "gps": ("gps", "nav_msgs/Odometry", (0, 1, 2)),
}
"""Name → topic, type, measured elements of the pose."""


def read_pose(position: tuple[float, float, float], orientation: Any) -> Pose:
    """Return a pose; without an orientation it is level.

    Raises:
        ValueError: a number is not finite, or the orientation is all zeros.
    """
    w, x, y, z = (
        (1.0, 0.0, 0.0, 0.0) if orientation is None else (orientation.w, orientation.x, orientation.y, orientation.z)
    )
    norm = math.hypot(w, x, y, z)
    if not math.isfinite(norm + sum(position)) or norm == 0.0:
        raise ValueError("it has numbers that are not finite, or an orientation of zeros")
    return Pose(position, (w / norm, x / norm, y / norm, z / norm))


def read_covariance(values: Sequence[float], size: int, indices: Sequence[int], default: float | None) -> _Array:
    """Return the covariance of some elements; if the first variance is 0, all are `default`.

    Raises:
        ValueError: a variance is 0 without a default, or not finite.
    """
    rows = list(indices)
    covariance = np.array(values, dtype=np.float64).reshape(size, size)[np.ix_(rows, rows)]
    if default is not None and covariance[0, 0] == 0.0:
        return default * np.eye(len(rows))
    variances = np.diagonal(covariance)
    if not np.isfinite(covariance).all() or (variances <= 0.0).any():
        raise ValueError("its covariance has a variance that is not positive")
    return np.clip(covariance, -MAX_VARIANCE, MAX_VARIANCE)
