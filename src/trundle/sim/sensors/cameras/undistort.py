"""Brown distortion and its inverse."""

import numpy as np
from numpy.typing import NDArray

from trundle.robots.model import Distortion

_Array = NDArray[np.float64]
_ROUNDS = 60
_STILL = 1e-9
_CLOSE = 1e-5
"""Accepted residual of the inverse [m at 1 m depth]: a hundredth of a pixel for most cameras."""


def undistorted(right: _Array, down: _Array, distortion: Distortion) -> tuple[_Array, _Array, NDArray[np.bool_]]:
    """Return the undistorted slopes and a mask of the valid ones: beyond its fold the distortion has no inverse."""
    x, y = right.copy(), down.copy()
    with np.errstate(all="ignore"):
        for _ in range(_ROUNDS):
            radial, dx, dy = _terms(x, y, distortion)
            last, x, y = x, (right - dx) / radial, (down - dy) / radial
            if np.all(np.abs(x - last) < _STILL):
                break
        back_x, back_y = distorted(x, y, distortion)
        sound = (np.abs(back_x - right) < _CLOSE) & (np.abs(back_y - down) < _CLOSE)
    return np.where(sound, x, 0.0), np.where(sound, y, 0.0), sound


def distorted(x: _Array, y: _Array, distortion: Distortion) -> tuple[_Array, _Array]:
    """Return the distorted slopes, as in OpenCV's plumb_bob."""
    radial, dx, dy = _terms(x, y, distortion)
    return x * radial + dx, y * radial + dy


def _terms(x: _Array, y: _Array, d: Distortion) -> tuple[_Array, _Array, _Array]:
    r2 = x * x + y * y
    radial = 1.0 + r2 * (d.k1 + r2 * (d.k2 + r2 * d.k3))
    dx = 2.0 * d.p1 * x * y + d.p2 * (r2 + 2.0 * x * x)
    dy = d.p1 * (r2 + 2.0 * y * y) + 2.0 * d.p2 * x * y
    return radial, dx, dy
