"""Faces of triangle meshes: whether they are closed, and the points that they use."""

import numpy as np
from numpy.typing import NDArray

_Points = NDArray[np.float64]
_Faces = NDArray[np.intp]
WELD = 1e-6
"""Distance below which vertices are merged [m]."""


def is_closed(faces: _Faces) -> bool:
    """True if every edge occurs once in each direction."""
    starts, ends = faces.ravel(), np.roll(faces, -1, axis=1).ravel()
    count = int(faces.max()) + 1
    forward, backward = np.sort(starts * count + ends), np.sort(ends * count + starts)
    return bool((forward[1:] != forward[:-1]).all()) and np.array_equal(forward, backward)


def used_points(faces: _Faces) -> _Faces:
    """Return the indices that faces contain, in order."""
    return np.flatnonzero(np.bincount(faces.ravel()))


def renumbered(faces: _Faces) -> _Faces:
    """Return faces with indices compacted to the used vertices, in order."""
    is_used = np.bincount(faces.ravel()) > 0
    return (np.cumsum(is_used) - 1)[faces]
