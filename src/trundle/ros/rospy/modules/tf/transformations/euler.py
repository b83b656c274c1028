"""Euler angles in any of the 24 conventions.

A convention is `s` (static axes) or `r` (rotating axes) and the order of the axes, as in `sxyz`; or the tuple
(first axis, parity, repetition, frame) of Ken Shoemake, Euler Angle Conversion, Graphics Gems IV, 1994.
"""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, cast

import numpy as np

from .quaternions import quaternion_matrix, quaternion_multiply
from .vectors import _EPS

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from .vectors import Array, Vector

_Convention = tuple[int, int, int, int]
_NEXT_AXIS = [1, 2, 0, 1]


def _axes_table() -> dict[str, _Convention]:
    """Name of each convention → its tuple; rotating axes are static ones in the reverse order."""
    table: dict[str, _Convention] = {}
    for first in range(3):
        for parity in range(2):
            second, third = _NEXT_AXIS[first + parity], _NEXT_AXIS[first - parity + 1]
            for repetition, last in enumerate((third, first)):
                order = "".join("xyz"[axis] for axis in (first, second, last))
                table["s" + order] = (first, parity, repetition, 0)
                table["r" + order[::-1]] = (first, parity, repetition, 1)
    return table


_AXES2TUPLE = _axes_table()
_TUPLE2AXES = {code: name for name, code in _AXES2TUPLE.items()}


def _convention(axes: str | Sequence[int]) -> _Convention:
    """First axis, parity, repetition and frame of a name or a tuple; KeyError if the convention is unknown."""
    name = axes.lower() if isinstance(axes, str) else _TUPLE2AXES[cast("_Convention", tuple(axes))]
    return _AXES2TUPLE[name]


def euler_matrix(ai: float, aj: float, ak: float, axes: str | Sequence[int] = "sxyz") -> "Array":
    """4×4 rotation from three angles."""
    return quaternion_matrix(quaternion_from_euler(ai, aj, ak, axes))


def euler_from_matrix(matrix: "ArrayLike", axes: str | Sequence[int] = "sxyz") -> tuple[float, float, float]:
    """Three angles of the upper left 3×3 of a matrix."""
    i, parity, repetition, frame = _convention(axes)
    j, k = _NEXT_AXIS[i + parity], _NEXT_AXIS[i - parity + 1]
    m = np.asarray(matrix, dtype=np.float64)
    if repetition:
        sin = math.hypot(m[i, j], m[i, k])
        middle = math.atan2(sin, m[i, i])
        if sin > _EPS:
            first, last = math.atan2(m[i, j], m[i, k]), math.atan2(m[j, i], -m[k, i])
        else:  # first and last axis coincide
            first, last = math.atan2(-m[j, k], m[j, j]), 0.0
    else:
        cos = math.hypot(m[i, i], m[j, i])
        middle = math.atan2(-m[k, i], cos)
        if cos > _EPS:
            first, last = math.atan2(m[k, j], m[k, k]), math.atan2(m[j, i], m[i, i])
        else:  # gimbal lock
            first, last = math.atan2(-m[j, k], m[j, j]), 0.0
    if parity:
        first, middle, last = -first, -middle, -last
    return (last, middle, first) if frame else (first, middle, last)


def euler_from_quaternion(quaternion: "Vector", axes: str | Sequence[int] = "sxyz") -> tuple[float, float, float]:
    """Three angles of a quaternion."""
    return euler_from_matrix(quaternion_matrix(quaternion), axes)


def quaternion_from_euler(ai: float, aj: float, ak: float, axes: str | Sequence[int] = "sxyz") -> "Array":
    """Quaternion from three angles."""
    i, parity, repetition, frame = _convention(axes)
    j, k = _NEXT_AXIS[i + parity], _NEXT_AXIS[i - parity + 1]
    first, last = (ak, ai) if frame else (ai, ak)
    turns = [_about(i, first), _about(j, aj), _about(i if repetition else k, last)]
    return quaternion_multiply(turns[2], quaternion_multiply(turns[1], turns[0]))


def _about(axis: int, angle: float) -> list[float]:
    """Quaternion of a turn about x, y or z (0, 1, 2)."""
    quaternion = [0.0, 0.0, 0.0, math.cos(angle / 2.0)]
    quaternion[axis] = math.sin(angle / 2.0)
    return quaternion
