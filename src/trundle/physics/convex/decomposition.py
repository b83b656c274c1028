"""Hollow bodies that move, as a few convex pieces: sheets along the surface, or V-HACD's.

K. Mamou: Volumetric Hierarchical Approximate Convex Decomposition. Game Engine Gems 3, 2016. One thread and no limit of
time, so that the same mesh has the same pieces everywhere; a few tenths of a second each.
"""

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from .hulls import Hull, area_of, hull_of, surface_error, volume_of
from .native_output import native_output_hidden
from .shell_decomposition import shell_pieces

_Points = NDArray[np.float64]
_Faces = NDArray[np.intp]
MAX_FACES = 100_000
"""Faces of the largest mesh that is cut."""
_FULL: Mapping[str, object] = {
    "maxConvexHulls": 16,
    "resolution": 20_000,
    "minimumVolumePercentErrorAllowed": 2.0,
    "maxRecursionDepth": 6,
    "fillMode": "flood",
    "maxNumVerticesPerCH": 32,
    "asyncACD": False,
    "minEdgeLength": 2,
    "findBestPlane": False,
}
_COARSE: Mapping[str, object] = {**_FULL, "maxConvexHulls": 8, "resolution": 5_000, "maxRecursionDepth": 3}
_NEAR = 0.01
"""Part of the mesh's size: pieces nearer to it than this are good."""
_FEW = 96
"""Faces of a thin surface that sheets are tried on first: they take a hundredth of a second."""
MAX_SHEETED = 20_000
"""Faces."""
_THIN = 0.03
"""Part of its size that half a wall's thickness is at most where sheets may do better than voxels."""
_SWEEPS = 4


def decompose(
    points: _Points, faces: _Faces, hull: Hull, *, closed: bool, coarse: bool = False
) -> list[_Points] | None:
    """Cut a mesh into convex pieces, whose corners come back; None where that makes nothing better.

    The pieces together have every corner of the mesh's hull, and nothing outside: it stands as the mesh would.

    Args:
        points: (N, 3) [m].
        faces: (M, 3) indices into them.
        hull: around all of it.
        closed: whether the surface has an inside; what has none becomes a wall of a few hundredths of its size.
        coarse: into fewer pieces, which takes a fraction of the time.
    """
    if len(faces) > MAX_FACES:
        return None
    return _candidates(points, faces, hull, closed, coarse) or None


def _candidates(points: _Points, faces: _Faces, hull: Hull, closed: bool, coarse: bool) -> list[_Points]:
    """Whichever is nearer to the mesh; voxels, which leave no hollow in a wall, unless sheets are so by far."""
    size = float(np.ptp(points, axis=0).max())
    triangles = points[faces]
    is_shell = not closed or is_thin(triangles, size)
    if is_shell and len(faces) <= _FEW:
        sheets = _solids(shell_pieces(points, faces, closed=closed), hull)
        if surface_error(triangles, sheets, closed=closed) < _NEAR * size:
            return _with_hull_corners(hull, sheets)
    voxels = _solids(_voxels(points, faces, size, closed=closed, coarse=coarse), hull)
    from_voxels = surface_error(triangles, voxels, closed=closed) if len(voxels) > 1 else np.inf
    if is_shell and not coarse and from_voxels > _NEAR * size and len(faces) <= MAX_SHEETED:
        sheets = _solids(shell_pieces(points, faces, closed=closed), hull)
        if 2 * surface_error(triangles, sheets, closed=closed) < from_voxels:
            return _with_hull_corners(hull, sheets)
    return _with_hull_corners(hull, voxels) if len(voxels) > 1 else []


def is_thin(triangles: _Points, size: float) -> bool:
    """Whether a closed surface (F, 3, 3) of some size [m] is a wall around something hollow."""
    return volume_of(triangles) < _THIN * size * area_of(triangles)


def _voxels(points: _Points, faces: _Faces, size: float, *, closed: bool, coarse: bool) -> list[_Points]:
    from vhacdx import compute_vhacd  # few worlds need it

    # Its grid is made for bodies about as large as one.
    middle = points.mean(axis=0)
    numbered = np.column_stack([np.full(len(faces), 3), faces]).astype(np.uint32)
    settings = _COARSE if coarse else _FULL
    with native_output_hidden():
        # A wall without thickness must not be shrunk onto its surface: nothing would be left of it.
        found = compute_vhacd((points - middle) / size, numbered.ravel(), shrinkWrap=closed, **settings)
    return [corners * size + middle for corners, _ in found]


def _solids(pieces: list[_Points], hull: Hull) -> list[Hull]:
    return [solid for piece in pieces if (solid := hull_of(_clip_to_hull(hull, piece))) is not None]


def _clip_to_hull(hull: Hull, corners: _Points) -> _Points:
    """Corners of a piece, those that stick out of the hull moved back onto it."""
    for _ in range(_SWEEPS):
        out = np.flatnonzero((corners @ hull.normals.T - hull.offsets).max(axis=0) > 0.0)
        for normal, offset in zip(hull.normals[out], hull.offsets[out], strict=True):
            corners = corners - np.outer(np.maximum(corners @ normal - offset, 0.0), normal)
    return corners


def _with_hull_corners(hull: Hull, solids: list[Hull]) -> list[_Points]:
    """Each piece with the corners of the hull that are nearest to it."""
    nearest = np.argmin([solid.signed_distances(hull.corners) for solid in solids], axis=0)
    return [np.concatenate([solid.corners, hull.corners[nearest == i]]) for i, solid in enumerate(solids)]
