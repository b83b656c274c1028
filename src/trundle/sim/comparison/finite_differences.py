"""Velocities of recorded poses, by differences."""

import numpy as np
from numpy.typing import NDArray

_Array = NDArray[np.float64]


def slopes(times: _Array, values: _Array) -> _Array:
    """Return derivatives of values by differences of both neighbors, at the ends of one; 0 for one sample.

    Args:
        times: (samples,) ascending [s].
        values: (samples, …)
    """
    before, after, span = _around(times)
    return (values[after] - values[before]) / span.reshape(-1, *(1,) * (values.ndim - 1))


def velocities(times: _Array, poses: _Array) -> _Array:
    """Return (samples, bodies, 6): linear [m/s] and angular velocities [rad/s] in the poses' frame, as `slopes`.

    Args:
        times: (samples,) ascending [s].
        poses: (samples, bodies, 7) x y z [m], qw qx qy qz.
    """
    before, after, span = _around(times)
    start, end = poses[before, :, 3:], poses[after, :, 3:]
    w, v, w_end, v_end = start[..., :1], start[..., 1:], end[..., :1], end[..., 1:]
    cosine = np.sum(start * end, axis=-1, keepdims=True)
    axis = np.where(cosine < 0.0, -1.0, 1.0) * (w * v_end - w_end * v + np.cross(v, v_end))
    sine = np.linalg.norm(axis, axis=-1, keepdims=True)
    angle = 2.0 * np.arctan2(sine, np.abs(cosine))
    turns = axis * angle / np.where(sine > 0.0, sine, 1.0)
    return np.concatenate([slopes(times, poses[..., :3]), turns / span[:, None, None]], axis=-1)


def _around(times: _Array) -> tuple[NDArray[np.intp], NDArray[np.intp], _Array]:
    """Return, for each sample, its neighbors, itself at the ends, and the time between them [s]; ∞ for one sample."""
    at = np.arange(len(times))
    before, after = np.maximum(at - 1, 0), np.minimum(at + 1, len(times) - 1)
    span = times[after] - times[before]
    return before, after, np.where(span > 0.0, span, np.inf)
