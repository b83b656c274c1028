"""Fewer corners for convex meshes: MuJoCo's hull takes 20 µs for each corner, and each step searches the corners."""

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from trundle.robots.meshes import SupportGraph

from .hulls import hull_of
from .mesh_faces import renumbered, used_points

_Points = NDArray[np.float64]
_Faces = NDArray[np.intp]
MAX_CORNERS = 20_000
"""Corners of a convex mesh up to which all are used."""
_TOLERANCE = 2.5e-4
"""Distance of the simplified surface, relative to the extents."""
_DIRECTIONS = 10_000
"""Directions along which the first corners are the highest."""
_STARTS = 512
"""Number of corners that are compared first; the climb to the highest corner starts at the best of them."""


class SimplifiedMesh(Struct, frozen=True):
    """Corners that stand for a convex mesh."""

    corners: _Points
    """(C, 3) [m]"""
    distance: float
    """Largest distance of the mesh from the hull of these corners [m]."""


def simplify(points: _Points, faces: _Faces) -> SimplifiedMesh | None:
    """Return some corners of a convex mesh, whose hull is nearly the mesh's; None if it is flat.

    They are the highest ones along evenly spread directions, then along the normals of the hull so far, until no corner
    is farther above any of its faces than the tolerance.

    Args:
        points: (N, 3) [m].
        faces: (M, 3) indices into points.
    """
    corners, faces = points[used_points(faces)], renumbered(faces)
    centred = corners - (corners.min(axis=0) + corners.max(axis=0)) / 2
    covariance = np.cov(centred.T)
    # Rounded, and without BLAS, whose last bits differ between processors: the principal axes of a ball are arbitrary.
    axes = np.linalg.eigh(np.round(covariance / np.abs(covariance).max(), 6))[1]
    along = sum(centred[:, i, None] * np.round(axes[i], 6) for i in range(3))
    extents = np.ptp(along, axis=0)
    if not extents.all():
        return None
    shape = along / extents  # scaled to extents 1; the hull of scaled points is the scaled hull
    graph = SupportGraph(shape, faces)
    kept = np.unique(highest(graph, shape, _spread_directions(_DIRECTIONS)))
    while (hull := hull_of(shape[kept])) is not None:
        tops = graph.climb(hull.normals, kept[hull.bases])
        heights = np.einsum("ij,ij->i", shape[tops], hull.normals) - hull.offsets
        missing = np.setdiff1d(tops[heights > _TOLERANCE / 2], kept)
        if heights.max() <= _TOLERANCE or not len(missing):
            distances = heights / np.linalg.norm(hull.normals / extents, axis=1)
            return SimplifiedMesh(corners[kept], max(float(distances.max()), 0.0))
        kept = np.union1d(kept, missing)
    return None


def highest(graph: SupportGraph, corners: _Points, directions: _Points) -> _Faces:
    """Return the indices of the highest corners (C, 3) of a convex body along directions (D, 3), (D,)."""
    samples = np.arange(0, len(corners), -(-len(corners) // _STARTS))
    return graph.climb(directions, samples[(directions @ corners[samples].T).argmax(axis=1)])


def _spread_directions(count: int) -> _Points:
    """Return unit vectors (N, 3), evenly spread by the golden angle."""
    heights = 1 - (2 * np.arange(count) + 1) / count
    turns = np.arange(count) * np.pi * (3 - np.sqrt(5))
    radii = np.sqrt(1 - heights**2)
    return np.column_stack([radii * np.cos(turns), radii * np.sin(turns), heights])
