"""Operations on NumPy arrays: poses are rows x y z qw qx qy qz, quaternions rows w x y z."""

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from .pose import Pose
from .quaternions import Quaternion, rotated_axes

_Array = NDArray[np.float64]
_CONJUGATE = np.array([1.0, -1.0, -1.0, -1.0])


def pose_from_row(row: _Array) -> Pose:
    """Return the pose of a row (7,)."""
    x, y, z, qw, qx, qy, qz = row.tolist()
    return Pose((x, y, z), (qw, qx, qy, qz))


def rows_from_poses(poses: Iterable[Pose]) -> _Array:
    """Stack poses into (N, 7)."""
    return np.array([(*pose.position, *pose.quaternion) for pose in poses], dtype=np.float64).reshape(-1, 7)


def finite_rows(poses: _Array) -> NDArray[np.bool_]:
    """Return (N,) a mask of the rows of (N, 7) without NaN or infinity."""
    return np.asarray(np.isfinite(poses).all(axis=1), dtype=np.bool_)


def compose_rows(a_from_b: _Array, b_from_c: _Array) -> _Array:
    """Return `a_from_c` (N, 7), row by row."""
    position = a_from_b[:, :3] + rotate_rows(a_from_b[:, 3:], b_from_c[:, :3])
    return np.hstack([position, multiply_rows(a_from_b[:, 3:], b_from_c[:, 3:])])


def invert_rows(a_from_b: _Array) -> _Array:
    """Return `b_from_a` (N, 7), row by row."""
    inverse = conjugate_rows(a_from_b[:, 3:])
    return np.hstack([-rotate_rows(inverse, a_from_b[:, :3]), inverse])


def rotate_rows(q: _Array, v: _Array) -> _Array:
    """Rotate vectors (N, 3) by unit quaternions (N, 4): v + 2w(u × v) + 2u × (u × v)."""
    t = 2.0 * np.cross(q[:, 1:], v)
    return v + q[:, :1] * t + np.cross(q[:, 1:], t)


def multiply_rows(a: _Array, b: _Array) -> _Array:
    """Return the Hamilton products of quaternions (N, 4): rotation by b, then by a."""
    scalar = a[:, 0] * b[:, 0] - np.einsum("ij,ij->i", a[:, 1:], b[:, 1:])
    vector = a[:, :1] * b[:, 1:] + b[:, :1] * a[:, 1:] + np.cross(a[:, 1:], b[:, 1:])
    return np.concatenate([scalar[:, None], vector], axis=1)


def conjugate_rows(q: _Array) -> _Array:
    """Return the inverse rotations (N, 4)."""
    return q * _CONJUGATE


def rotate_vectors(a_from_b: Pose, directions: _Array) -> _Array:
    """Express directions (…, 3) given in frame b in frame a."""
    return directions @ np.array(rotated_axes(a_from_b.quaternion))


def transform_points(a_from_b: Pose, points: _Array) -> _Array:
    """Express points (…, 3) given in frame b in frame a."""
    return rotate_vectors(a_from_b, points) + np.array(a_from_b.position)


def matrix_from_quaternion(q: Quaternion) -> _Array:
    """Return the (3, 3) rotation matrix of a unit quaternion."""
    w, x, y, z = q
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def quaternion_from_matrix(m: _Array) -> Quaternion:
    """Return the unit quaternion of a rotation matrix (3, 3)."""
    w, x, y, z = quaternions_from_matrices(m[None])[0].tolist()
    return (w, x, y, z)


def quaternions_from_matrices(m: _Array) -> _Array:
    """Return unit quaternions (N, 4) of rotation matrices (N, 3, 3), by the largest of Shepperd's four forms."""
    trace = np.trace(m, axis1=1, axis2=2)
    forms = np.empty((len(m), 4, 4))
    forms[:, 0, 0] = 1 + trace
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        forms[:, i + 1, i + 1] = 1 + 2 * m[:, i, i] - trace
        forms[:, 0, i + 1] = forms[:, i + 1, 0] = m[:, k, j] - m[:, j, k]
        forms[:, i + 1, j + 1] = forms[:, j + 1, i + 1] = m[:, j, i] + m[:, i, j]
    largest = forms[np.arange(len(m)), np.diagonal(forms, axis1=1, axis2=2).argmax(axis=1)]
    return np.asarray(largest / np.linalg.norm(largest, axis=1, keepdims=True), dtype=np.float64)
