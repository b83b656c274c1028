"""Convex decomposition of moving concave meshes, by sheets along the surface or by V-HACD.

K. Mamou: Volumetric Hierarchical Approximate Convex Decomposition. Game Engine Gems 3, 2016. Single-threaded and
without a time limit, so that a mesh has the same pieces on every machine; a few tenths of a second each.
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
"""Maximum number of faces of a mesh that is decomposed."""
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
"""Accepted surface error relative to the mesh size."""
_FEW = 96
"""Maximum number of faces of a thin mesh for which sheets are tried first, which takes a hundredth of a second."""
MAX_SHEETED = 20_000
"""Maximum number of faces of a mesh for which sheets are tried."""
_THIN = 0.03
"""Largest half wall thickness, relative to the mesh size, at which sheets may beat voxels."""
_SWEEPS = 4


def decompose(
    points: _Points, faces: _Faces, hull: Hull, *, closed: bool, coarse: bool = False
) -> list[_Points] | None:
    """Decompose a mesh into convex pieces; return the corners of each, or None if the hull is as good.

    The pieces together contain every corner of the mesh's hull and nothing outside it, so the mesh stands as before.

    Args:
        points: (N, 3) [m].
        faces: (M, 3) indices into points.
        hull: hull of the points.
        closed: True if the surface is closed; an open one becomes a wall of a few hundredths of its size.
        coarse: True: fewer pieces, in a fraction of the time.
    """
    if len(faces) > MAX_FACES:
        return None
    return _candidates(points, faces, hull, closed, coarse) or None


def _candidates(points: _Points, faces: _Faces, hull: Hull, closed: bool, coarse: bool) -> list[_Points]:
    """Return the pieces with the smaller surface error; V-HACD's pieces, which leave no cavity in a wall, unless
    sheets are far better.
    """
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
    """True if a closed surface (F, 3, 3) of some size [m] is a thin wall around a cavity."""
    return volume_of(triangles) < _THIN * size * area_of(triangles)


def _voxels(points: _Points, faces: _Faces, size: float, *, closed: bool, coarse: bool) -> list[_Points]:
    from vhacdx import compute_vhacd  # imported here, as few worlds need it

    # V-HACD's grid suits bodies of about unit size.
    middle = points.mean(axis=0)
    numbered = np.column_stack([np.full(len(faces), 3), faces]).astype(np.uint32)
    settings = _COARSE if coarse else _FULL
    with native_output_hidden():
        # An open wall must not be shrink-wrapped onto its surface: nothing would remain.
        hulls = compute_vhacd((points - middle) / size, numbered.ravel(), shrinkWrap=closed, **settings)
    return [corners * size + middle for corners, _ in hulls]


def _solids(pieces: list[_Points], hull: Hull) -> list[Hull]:
    return [solid for piece in pieces if (solid := hull_of(_clip_to_hull(hull, piece))) is not None]


def _clip_to_hull(hull: Hull, corners: _Points) -> _Points:
    """Return a piece's corners, with those outside the hull projected onto it."""
    for _ in range(_SWEEPS):
        out = np.flatnonzero((corners @ hull.normals.T - hull.offsets).max(axis=0) > 0.0)
        for normal, offset in zip(hull.normals[out], hull.offsets[out], strict=True):
            corners = corners - np.outer(np.maximum(corners @ normal - offset, 0.0), normal)
    return corners


def _with_hull_corners(hull: Hull, solids: list[Hull]) -> list[_Points]:
    """Return each piece with the hull corners nearest to it."""
    nearest = np.argmin([solid.signed_distances(hull.corners) for solid in solids], axis=0)
    return [np.concatenate([solid.corners, hull.corners[nearest == i]]) for i, solid in enumerate(solids)]
