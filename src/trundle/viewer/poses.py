"""Rigid transforms on whole arrays: rows of x y z qw qx qy qz."""

import numpy as np
from numpy.typing import NDArray

from trundle.spatial import Pose

Array = NDArray[np.float64]


def rows_of(poses: list[Pose]) -> Array:
    """Stack poses into an (N, 7) array."""
    return np.array([(*p.position, *p.quaternion) for p in poses], dtype=np.float64).reshape(-1, 7)


def known(poses: Array) -> NDArray[np.bool_]:
    """Return which rows are poses: (N,), false where any number is NaN or infinite."""
    return np.asarray(np.isfinite(poses).all(axis=1), dtype=np.bool_)


def rotated(q: Array, v: Array) -> Array:
    """Rotate vectors (N, 3) by unit quaternions (N, 4): v + 2w(u × v) + 2u × (u × v)."""
    t = 2.0 * np.cross(q[:, 1:], v)
    return v + q[:, :1] * t + np.cross(q[:, 1:], t)


def multiplied(a: Array, b: Array) -> Array:
    """Hamilton products of quaternions (N, 4): first b, then a."""
    w = a[:, :1] * b[:, :1] - np.sum(a[:, 1:] * b[:, 1:], axis=1, keepdims=True)
    return np.hstack([w, a[:, :1] * b[:, 1:] + b[:, :1] * a[:, 1:] + np.cross(a[:, 1:], b[:, 1:])])


def composed(a_from_b: Array, b_from_c: Array) -> Array:
    """`a_from_c`, row by row."""
    position = a_from_b[:, :3] + rotated(a_from_b[:, 3:], b_from_c[:, :3])
    return np.hstack([position, multiplied(a_from_b[:, 3:], b_from_c[:, 3:])])


def inverted(a_from_b: Array) -> Array:
    """`b_from_a`, row by row."""
    conjugate = a_from_b[:, 3:] * np.array([1.0, -1.0, -1.0, -1.0])
    return np.hstack([-rotated(conjugate, a_from_b[:, :3]), conjugate])
