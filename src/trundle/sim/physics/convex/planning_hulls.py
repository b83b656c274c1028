"""Meshes as the collision checks of planners need them: convex parts as hulls of few corners."""

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from .hulls import hull_of
from .mesh_decomposition import WorldDecomposition
from .splitting import split_mesh

_Points = NDArray[np.float64]
_MANY = 20_000
"""Points beyond which only the highest along many directions are looked at."""
_BLOCK = 50_000
_FILLED = 0.02
"""Distance of the pieces from the mesh up to which they stand for it [m]."""
_FEW = 2000
"""Maximum number of triangles that are checked one by one."""


def convex_parts(vertices: _Points, faces: NDArray[np.intp]) -> list[_Points] | None:
    """Return the corners (N, 3) [m] of each part of a mesh if all are convex; None if one is not.

    Args:
        vertices: (N, 3) [m].
        faces: (M, 3) indices into vertices.
    """
    split = split_mesh(vertices, faces, fixed=False)
    return None if split.concave else split.corners


def moving_pieces(meshes: Iterable[tuple[_Points, NDArray[np.intp]]]) -> list[list[_Points] | None]:
    """Return convex pieces of meshes that move, in worker processes if that takes long; they are kept on disk.

    None: the pieces would fill what is open, as those of some walls without a back; its triangles are few enough.

    Args:
        meshes: vertices (N, 3) [m] and faces (M, 3) of each.
    """
    decomposition = WorldDecomposition()
    listed = list(meshes)
    decomposition.decompose_all((vertices, faces, False) for vertices, faces in listed)
    made = [decomposition.pieces_of(vertices, faces, fixed=False).pieces for vertices, faces in listed]
    return [
        None
        if len(faces) <= _FEW and max((error.distance for error in pieces.errors), default=0.0) > _FILLED
        else pieces.corners
        for (_, faces), pieces in zip(listed, made, strict=True)
    ]


def hull_corners(points: _Points, max_count: int) -> _Points:
    """Return the corners of the hull of points (N, 3) [m]; of more than `max_count` the highest along as many evenly
    spread directions, moved outwards until their hull contains the others.
    """
    if len(points) > _MANY:
        points = points[_extremes(points, 4 * max_count)]
    hull = hull_of(points)
    if hull is None:
        return _flat_corners(points, max_count)
    if len(hull.corners) <= max_count:
        return hull.corners
    kept = hull.corners[_extremes(hull.corners, max_count)]
    fewer = hull_of(kept)
    if fewer is None:
        return kept
    middle = kept.mean(axis=0)
    beyond = float(fewer.signed_distances(hull.corners).max())
    inside = float((fewer.offsets - fewer.normals @ middle).min())  # radius of a ball inside
    return middle + (kept - middle) * (1.0 + max(beyond, 0.0) / max(inside, 1e-6))


def _flat_corners(points: _Points, max_count: int) -> _Points:
    return points if len(points) <= max_count else points[_extremes(points, max_count)]


def _extremes(points: _Points, count: int) -> NDArray[np.intp]:
    heights = 1 - (2 * np.arange(count) + 1) / count
    turns = np.arange(count) * np.pi * (3 - np.sqrt(5))
    radii = np.sqrt(1 - heights**2)
    directions = np.column_stack([radii * np.cos(turns), radii * np.sin(turns), heights])
    best = np.full(count, -np.inf)
    numbers = np.zeros(count, dtype=np.intp)
    for first in range(0, len(points), _BLOCK):
        along = points[first : first + _BLOCK] @ directions.T
        top = along.argmax(axis=0)
        value = along[top, np.arange(count)]
        is_higher = value > best
        best[is_higher] = value[is_higher]
        numbers[is_higher] = first + top[is_higher]
    return np.unique(numbers)
