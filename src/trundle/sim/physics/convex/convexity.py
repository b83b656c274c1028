"""Test whether a closed mesh is convex, in a time that grows with its edges."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from trundle.robots.meshes import SupportGraph, fold_height

from .hulls import hull_of
from .simplification import highest

_Points = NDArray[np.float64]
_Faces = NDArray[np.intp]
_DENT = 2e-3
"""Depth of a dent, relative to the size, up to which a mesh counts as convex."""
_FEW = 64
"""Faces whose planes are compared with every point."""
_MANY = 4096
"""Faces whose planes are compared with a hull at once."""


def is_convex(points: _Points, faces: _Faces, vertices: _Points) -> bool:
    """True if the faces form a closed convex body.

    Single faces may be flipped, as in many published meshes; if all are flipped, the mesh is a room seen from inside,
    which is not convex.

    Args:
        points: (N, 3) [m].
        faces: (M, 3) indices into points, none without area.
        vertices: points used by the faces.
    """
    dent = _DENT * float(np.ptp(vertices, axis=0).max())
    middle = vertices.mean(axis=0)
    points, vertices = points - middle, vertices - middle
    height = fold_height(points, faces)
    if height is None:
        return False
    if height <= dent:
        return True
    a, b, c = (points[faces[:, i]] for i in range(3))
    normals = np.cross(b - a, c - a)
    normals /= np.sqrt(np.einsum("ij,ij->i", normals, normals))[:, None]
    return _are_heights_within(dent, normals, np.einsum("ij,ij->i", normals, a), vertices)


def _are_heights_within(dent: float, normals: _Points, offsets: _Points, vertices: _Points) -> bool:
    """True if the points lie on one side of each face, within a dent [m], and below at least one face."""
    step = -(-len(normals) // _FEW)
    subset = slice(None, None, step)  # faces all over the surface: most dents break the planes of many faces
    is_within, has_outside = _compare(
        dent, normals[subset], offsets[subset], lambda along: (along @ vertices.T).max(axis=1)
    )
    if not is_within or step == 1:
        return is_within and has_outside
    hull = hull_of(vertices)
    if hull is None:  # flat: all faces are in one plane
        return has_outside
    graph = SupportGraph(hull.corners, hull.faces)

    def heights(directions: _Points) -> _Points:
        return np.einsum("ij,ij->i", hull.corners[highest(graph, hull.corners, directions)], directions)

    for first in range(0, len(normals), _MANY):
        subset = slice(first, first + _MANY)
        is_within, is_outside = _compare(dent, normals[subset], offsets[subset], heights)
        if not is_within:
            return False
        has_outside = has_outside or is_outside
    return has_outside


def _compare(
    dent: float, normals: _Points, offsets: _Points, highest: Callable[[_Points], _Points]
) -> tuple[bool, bool]:
    """Return if all points lie on one side of each face, and below any face, within a dent [m].

    Args:
        dent: tolerance [m].
        normals: (F, 3) of the faces.
        offsets: (F,) of the faces [m].
        highest: returns the largest height of the points along each direction (D, 3), (D,) [m].
    """
    above, below = highest(normals) - offsets, highest(-normals) + offsets
    return bool(np.minimum(above, below).max() <= dent), bool((above <= dent).any())
