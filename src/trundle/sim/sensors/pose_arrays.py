"""Poses applied to arrays of points and directions."""

import numpy as np
from numpy.typing import NDArray

from trundle.spatial import Pose

_Array = NDArray[np.float64]
_AXES = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


def pose_of(row: _Array) -> Pose:
    """Return the pose in a row of `Snapshot.poses`."""
    x, y, z, qw, qx, qy, qz = row.tolist()
    return Pose((x, y, z), (qw, qx, qy, qz))


def rotate_vectors(a_from_b: Pose, directions: _Array) -> _Array:
    """Return (…, 3) directions of frame b in frame a."""
    return directions @ np.array([a_from_b.transform_vector(axis) for axis in _AXES])


def transform_points(a_from_b: Pose, points: _Array) -> _Array:
    """Return (…, 3) points of frame b in frame a."""
    return rotate_vectors(a_from_b, points) + np.array(a_from_b.position)
