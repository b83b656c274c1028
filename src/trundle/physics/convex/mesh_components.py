"""Connected components of triangle meshes, and tests for closed and convex ones."""

import numpy as np
from numpy.typing import NDArray

_Points = NDArray[np.float64]
_Faces = NDArray[np.intp]
WELD = 1e-6
"""Distance below which vertices are merged [m]."""
_DENT = 2e-3
"""Depth of a dent, relative to the size, up to which a component counts as convex."""


def welded(vertices: _Points, faces: _Faces) -> tuple[_Points, _Faces]:
    """Return points with duplicates merged, and faces without degenerate ones."""
    _, first, number = np.unique(np.round(vertices / WELD), axis=0, return_index=True, return_inverse=True)
    points, faces = vertices[first], number.reshape(-1)[faces]
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


def is_convex(points: _Points, faces: _Faces, own: _Points) -> bool:
    """True if the faces form a closed convex body.

    Single faces may be flipped, as in many published meshes; with all of them flipped it is a room seen from inside.
    """
    edges = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    if np.any(np.unique(edges, axis=0, return_counts=True)[1] != 2):
        return False
    dent = _DENT * float(np.ptp(own, axis=0).max())
    a, b, c = (points[faces[:, i]] for i in range(3))
    normals = np.cross(b - a, c - a)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    offsets = np.einsum("ij,ij->i", normals, a)
    has_outside = False
    for some in range(0, len(faces), 256):
        heights = normals[some : some + 256] @ own.T - offsets[some : some + 256, None]
        above, below = heights.max(axis=1), -heights.min(axis=1)
        if np.minimum(above, below).max() > dent:
            return False
        has_outside = has_outside or bool((above <= dent).any())
    return has_outside


def is_closed(faces: _Faces) -> bool:
    """True if every edge occurs once in each direction."""
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    once = len(np.unique(edges, axis=0)) == len(edges)
    return once and len(np.unique(np.concatenate([edges, edges[:, ::-1]]), axis=0)) == len(edges)


def renumbered(faces: _Faces) -> _Faces:
    """Return faces with indices compacted to the used vertices, in order."""
    return np.unique(faces, return_inverse=True)[1].reshape(faces.shape)
