"""Convex pieces of concave parts of meshes, because MuJoCo's contacts are convex."""

import hashlib
from enum import Enum

import numpy as np
from msgspec import Struct
from msgspec.structs import replace
from numpy.typing import NDArray

from .decomposition import MAX_FACES, MAX_SHEETED, decompose, is_thin
from .hulls import hausdorff_distance, hull_of, surface_error, volume_of
from .mesh_faces import is_closed
from .shell_decomposition import shell_pieces

_Points = NDArray[np.float64]
_Faces = NDArray[np.intp]
_VERSION = 4
"""Version of the cache keys; raised when a mesh gets different pieces."""
_HOLLOW = 0.05
"""Surface error of the hull, relative to the size, up to which it replaces a concave mesh."""
_FULL = 1.1
"""Ratio of the hull's volume to the mesh's up to which it replaces a concave mesh."""
_MAX_FLAT = 2000
"""Maximum number of faces of a flat mesh that is decomposed."""


class Detail(Enum):
    """Level of detail of a concave part's pieces."""

    FULL = "full"
    COARSE = "coarse"
    """Fewer pieces, in a fraction of the time."""
    HULL = "hull"
    """One convex hull."""


class HullError(Struct, frozen=True):
    """Deviation of the simulated shape from a concave mesh."""

    volume_ratio: float | None
    """Volume of the pieces over that of the mesh; None for an open mesh."""
    distance: float
    """Largest distance between the two surfaces [m]."""
    is_filled: bool
    """True if a cavity was filled."""


class ConvexPieces(Struct, frozen=True):
    """Convex pieces of a mesh."""

    corners: list[_Points]
    """(N, 3) corners of each; the piece is their hull."""
    errors: list[HullError]
    """Deviation of each part that is not exact."""


class ConcavePart(Struct, frozen=True, eq=False):
    """Connected concave part of a moving mesh, relative to its lowest corner, so that copies compare equal."""

    points: _Points
    """(N, 3) [m]"""
    faces: _Faces
    """(M, 3) indices into points."""
    detail: Detail

    @property
    def key(self) -> str:
        """Cache key; equal for equal pieces."""
        settings = f"{_VERSION} {self.detail.value} {len(self.points)} ".encode()
        return hashlib.sha256(settings + self.points.tobytes() + self.faces.astype(np.int64).tobytes()).hexdigest()

    @property
    def seconds(self) -> float:
        """Upper estimate of the decomposition time on one processor [s], from the size only."""
        count = len(self.faces)
        if self.detail is Detail.HULL or count > MAX_FACES:
            return 0.05
        if self.detail is Detail.COARSE:
            return 0.3 + 2e-5 * count
        size = float(np.ptp(self.points, axis=0).max())
        is_shell = count <= MAX_SHEETED and (not is_closed(self.faces) or is_thin(self.points[self.faces], size))
        return 0.5 + (1e-3 if is_shell else 5e-5) * count


def decompose_part(part: ConcavePart) -> ConvexPieces:
    """Return the pieces of a concave part, or its hull."""
    points, faces = part.points, part.faces
    hull = hull_of(points)
    triangles, closed = points[faces], is_closed(faces)
    if hull is None:
        return _flat(points, faces, triangles)
    mesh_volume = volume_of(triangles) if closed else 0.0
    ratio = hull.volume / mesh_volume if mesh_volume > 0 else None
    error = HullError(ratio, hausdorff_distance(hull.triangles, triangles), is_filled=True)
    is_hollow = error.distance > _HOLLOW * float(np.ptp(points, axis=0).max()) and not (ratio and ratio < _FULL)
    if part.detail is not Detail.HULL and is_hollow:
        cut = decompose(points, faces, hull, closed=closed, coarse=part.detail is Detail.COARSE) or []
        solids = [solid for piece in cut if (solid := hull_of(piece)) is not None]
        volume, away = sum(solid.volume for solid in solids), surface_error(triangles, solids, closed=closed)
        if volume < hull.volume / _FULL and away < error.distance:
            return ConvexPieces(cut, [HullError(volume / mesh_volume if ratio else None, away, is_filled=False)])
    return ConvexPieces([points], [error])


def hull_of_part(part: ConcavePart) -> ConvexPieces:
    """Return the hull of a part and its deviation."""
    return decompose_part(replace(part, detail=Detail.HULL))


def _flat(points: _Points, faces: _Faces, triangles: _Points) -> ConvexPieces:
    """Return a flat part as one layer if it is convex, else as thin walls."""
    walls = shell_pieces(points, faces, closed=False) if len(faces) <= _MAX_FLAT else []
    if len(walls) < 2:
        return ConvexPieces([points], [])
    solids = [solid for wall in walls if (solid := hull_of(wall)) is not None]
    return ConvexPieces(walls, [HullError(None, surface_error(triangles, solids, closed=False), is_filled=False)])
