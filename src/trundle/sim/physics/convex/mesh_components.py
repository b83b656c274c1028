"""Connected components of triangle meshes, and a test for closed ones."""

import numpy as np
from numpy.typing import NDArray

_Points = NDArray[np.float64]
_Faces = NDArray[np.intp]
WELD = 1e-6
"""Distance below which vertices are merged [m]."""


def welded(vertices: _Points, faces: _Faces) -> tuple[_Points, _Faces]:
    """Return points with duplicates merged, and faces without degenerate ones."""
    from trundle.robots.meshes import unique_rows  # the worker never welds and does not import it

    first, number = unique_rows(np.round(vertices / WELD))
    points, faces = vertices[first], number[faces]
    a, b, c = (points[faces[:, i]] for i in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    return points, faces[area > 1e-12]


def connected_components(count: int, faces: _Faces) -> _Faces:
    """Return for each vertex the smallest vertex index of its component."""
    labels = np.arange(count)
    while True:
        smallest = labels[faces].min(axis=1)
        new = labels.copy()
        np.minimum.at(new, faces.ravel(), np.repeat(smallest, 3))
        new = new[new]
        if np.array_equal(new, labels):
            return labels
        labels = new


def is_closed(faces: _Faces) -> bool:
    """True if every edge occurs once in each direction."""
    starts, ends = faces.ravel(), np.roll(faces, -1, axis=1).ravel()
    count = int(faces.max()) + 1
    forward, backward = np.sort(starts * count + ends), np.sort(ends * count + starts)
    return bool((forward[1:] != forward[:-1]).all()) and np.array_equal(forward, backward)


def renumbered(faces: _Faces) -> _Faces:
    """Return faces with indices compacted to the used vertices, in order."""
    return np.unique(faces, return_inverse=True)[1].reshape(faces.shape)
