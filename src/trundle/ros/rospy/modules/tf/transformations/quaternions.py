"""Quaternions [x, y, z, w]."""

import math
from typing import TYPE_CHECKING

import numpy as np

from .vectors import _EPS, unit_vector, vector_norm

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from .vectors import Array, Vector


def quaternion_about_axis(angle: float, axis: "Vector") -> "Array":
    """Quaternion of a turn by `angle` about an axis."""
    quaternion = np.zeros(4)
    quaternion[:3] = axis[:3]
    length = vector_norm(quaternion)
    if length > _EPS:
        quaternion *= math.sin(angle / 2.0) / length
    quaternion[3] = math.cos(angle / 2.0)
    return quaternion


def quaternion_matrix(quaternion: "Vector") -> "Array":
    """4×4 rotation; the quaternion may have any length."""
    x, y, z, w = np.array(quaternion[:4], dtype=np.float64)
    norm = x * x + y * y + z * z + w * w
    if norm < _EPS:
        return np.identity(4)
    s = 2.0 / norm
    return np.array(
        (
            (1.0 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w), 0.0),
            (s * (x * y + z * w), 1.0 - s * (x * x + z * z), s * (y * z - x * w), 0.0),
            (s * (x * z - y * w), s * (y * z + x * w), 1.0 - s * (x * x + y * y), 0.0),
            (0.0, 0.0, 0.0, 1.0),
        )
    )


def quaternion_from_matrix(matrix: "ArrayLike") -> "Array":
    """Quaternion of a 4×4 rotation; w ≥ 0 if the trace is positive."""
    m = np.array(matrix, dtype=np.float64)[:4, :4]
    quaternion = np.empty(4)
    trace = np.trace(m)
    if trace > m[3, 3]:
        quaternion[3] = trace
        quaternion[:3] = m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1]
        size = trace
    else:  # x, y or z is the largest component: compute it from the root
        i = 0
        if m[1, 1] > m[0, 0]:
            i = 1
        if m[2, 2] > m[i, i]:
            i = 2
        j, k = (i + 1) % 3, (i + 2) % 3
        size = m[i, i] - (m[j, j] + m[k, k]) + m[3, 3]
        quaternion[i] = size
        quaternion[j] = m[i, j] + m[j, i]
        quaternion[k] = m[k, i] + m[i, k]
        quaternion[3] = m[k, j] - m[j, k]
    return quaternion * (0.5 / math.sqrt(size * m[3, 3]))


def quaternion_multiply(quaternion1: "Vector", quaternion0: "Vector") -> "Array":
    """Hamilton product: the rotation `quaternion0`, then `quaternion1`."""
    x1, y1, z1, w1 = quaternion1
    x0, y0, z0, w0 = quaternion0
    return np.array(
        (
            w1 * x0 + x1 * w0 + y1 * z0 - z1 * y0,
            w1 * y0 - x1 * z0 + y1 * w0 + z1 * x0,
            w1 * z0 + x1 * y0 - y1 * x0 + z1 * w0,
            w1 * w0 - x1 * x0 - y1 * y0 - z1 * z0,
        ),
        dtype=np.float64,
    )


def quaternion_conjugate(quaternion: "Vector") -> "Array":
    """[-x, -y, -z, w]."""
    x, y, z, w = quaternion[:4]
    return np.array((-x, -y, -z, w), dtype=np.float64)


def quaternion_inverse(quaternion: "Vector") -> "Array":
    """Inverse of a quaternion of any length but zero."""
    return quaternion_conjugate(quaternion) / np.dot(quaternion, quaternion)


def quaternion_slerp(
    quat0: "Vector", quat1: "Vector", fraction: float, spin: float = 0, shortestpath: bool = True
) -> "Array":
    """Spherical linear interpolation: `quat0` at fraction 0, `quat1` at 1.

    Args:
        quat0: first quaternion.
        quat1: second quaternion.
        fraction: 0 to 1.
        spin: half turns to add.
        shortestpath: take the nearer of quat1 and -quat1.
    """
    start, end = unit_vector(quat0[:4]), unit_vector(quat1[:4])
    if fraction == 0.0:
        return start
    if fraction == 1.0:
        return end
    cos = np.dot(start, end)
    if abs(abs(cos) - 1.0) < _EPS:
        return start
    if shortestpath and cos < 0.0:
        cos, end = -cos, -end
    angle = math.acos(cos) + spin * math.pi
    if abs(angle) < _EPS:
        return start
    return (math.sin((1.0 - fraction) * angle) * start + math.sin(fraction * angle) * end) / math.sin(angle)


def random_quaternion(rand: "Vector | None" = None) -> "Array":
    """Uniformly distributed unit quaternion.

    Args:
        rand: three numbers in [0, 1); default: random.

    Formula: Ken Shoemake, Uniform Random Rotations, Graphics Gems III, 1992.
    """
    u, v, w = np.random.rand(3) if rand is None else rand
    a, b = 2.0 * math.pi * v, 2.0 * math.pi * w
    low, high = math.sqrt(1.0 - u), math.sqrt(u)
    return np.array((math.sin(a) * low, math.cos(a) * low, math.sin(b) * high, math.cos(b) * high))


def random_rotation_matrix(rand: "Vector | None" = None) -> "Array":
    """Uniformly distributed 4×4 rotation; `rand` as in `random_quaternion`."""
    return quaternion_matrix(random_quaternion(rand))
