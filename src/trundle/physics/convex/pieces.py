"""Concave meshes as convex pieces, which is all that MuJoCo can touch.

What hangs together in a mesh is one piece if it is convex. If it is not, and never moves, each flat face of it becomes
a slab as thick as a wall may be: so a room can be entered, and a ramp driven up. What moves is cut into a few nearly
convex pieces if it is truly hollow; else, and where that makes nothing better, it is filled.
"""

import hashlib
from enum import Enum

import numpy as np
from msgspec import Struct
from msgspec.structs import replace
from numpy.typing import NDArray

from .decomposition import MOST_FACES, MOST_SHEETED, decompose, is_thin
from .face_slabs import is_convex_layer, is_layer, slabs_of
from .hulls import distance, hull_of, surface_error, volume_of
from .mesh_components import WELD, is_closed, is_convex, islands_of, renumbered, welded
from .shell_decomposition import shell_pieces

_Points = NDArray[np.float64]
_Faces = NDArray[np.intp]
MOST_PIECES = 1000
"""Beyond so many, a mesh that moves is one convex hull."""
MOST_SLABS = 50_000
"""Slabs of all that stands in a world; a later mesh of more than 1000 is one hull."""
_CLOSE = 0.02
"""[m] Where its hull is nearer, what stands and takes over 1000 slabs is its hull."""
_VERSION = 4
"""Raised where the same mesh becomes other pieces."""
_HOLLOW = 0.05
"""Part of its size by which the hull of something hollow may be away from it, and it is filled all the same."""
_FULL = 1.1
"""Times its volume that a hull may have, and it is filled all the same."""
_MOST_CUT = 8
"""Parts of a mesh that are cut up, the largest first."""
_MOST_FLAT = 2000
"""Faces of something flat that is cut up."""


class Detail(Enum):
    """How closely pieces follow a hollow part."""

    FULL = "full"
    COARSE = "coarse"
    """Fewer pieces, in a fraction of the time."""
    HULL = "hull"
    """It is filled."""


class HullError(Struct, frozen=True):
    """How what is simulated differs from a mesh that is hollow."""

    times: float | None
    """Its volume over the mesh's; None where the mesh is open and has none."""
    away: float
    """[m] How far the two surfaces are from one another at most."""
    is_filled: bool
    """Whether something hollow was made solid."""


class ConvexPieces(Struct, frozen=True):
    """Convex pieces of a mesh."""

    corners: list[_Points]
    """(N, 3) of each; its hull is the piece."""
    misfits: list[HullError]
    """One for each part that is not what it is in the mesh."""


class HollowPart(Struct, frozen=True, eq=False):
    """A connected, non-convex part of a mesh that moves; placed from its lowest corner: copies compare equal."""

    points: _Points
    """(N, 3) [m]"""
    faces: _Faces
    """(M, 3) indices into them."""
    detail: Detail

    @property
    def key(self) -> str:
        """The same for the same pieces."""
        settings = f"{_VERSION} {self.detail.value} {len(self.points)} ".encode()
        return hashlib.sha256(settings + self.points.tobytes() + self.faces.astype(np.int64).tobytes()).hexdigest()

    @property
    def seconds(self) -> float:
        """[s] About how long it takes one processor to cut, at most; by its size, so that it is the same everywhere."""
        count = len(self.faces)
        if self.detail is Detail.HULL or count > MOST_FACES:
            return 0.05
        if self.detail is Detail.COARSE:
            return 0.3 + 2e-5 * count
        size = float(np.ptp(self.points, axis=0).max())
        is_shell = count <= MOST_SHEETED and (not is_closed(self.faces) or is_thin(self.points[self.faces], size))
        return 0.5 + (1e-3 if is_shell else 5e-5) * count


class Split(Struct, frozen=True):
    """A mesh before its hollow parts are cut."""

    corners: list[_Points]
    """(N, 3) of each convex piece [m]."""
    hollow: list[tuple[_Points, HollowPart]]
    """Each with where its lowest corner is (3,) [m]; the largest first."""


def split(vertices: _Points, faces: _Faces, *, fixed: bool) -> Split:
    """Find the convex pieces of a mesh, and what is hollow.

    Args:
        vertices: (N, 3) [m].
        faces: (M, 3) indices into them, counter-clockwise from outside.
        fixed: it never moves.
    """
    points, faces = welded(vertices, faces)
    if not len(faces):
        return Split([vertices], [])
    labels = islands_of(len(points), faces)[faces[:, 0]]
    order = np.argsort(labels, kind="stable")
    starts = np.flatnonzero(np.diff(labels[order])) + 1
    corners: list[_Points] = []
    hollow: list[_Faces] = []
    for island in np.split(faces[order], starts):
        own = points[np.unique(island)]
        if fixed and (is_layer(own) or not is_convex(points, island, own)):
            corners += slabs_of(points, island, own)
        elif fixed or is_convex(points, island, own) or is_convex_layer(points, island, own):
            corners.append(own)
        else:
            hollow.append(island)
        if len(corners) + len(hollow) > (MOST_SLABS if fixed else MOST_PIECES):
            return in_one(points, faces)
    if len(corners) > MOST_PIECES and _hull_is_close(points, faces):
        return in_one(points, faces)
    hollow.sort(key=lambda island: -float(np.prod(np.ptp(points[np.unique(island)], axis=0))))
    details = [Detail.FULL if i < _MOST_CUT else Detail.HULL for i in range(len(hollow))]
    return Split(corners, [_hollow(points, island, detail) for island, detail in zip(hollow, details, strict=True)])


def in_one(vertices: _Points, faces: _Faces) -> Split:
    """Leave a mesh whole, which fills it."""
    points, faces = welded(vertices, faces)
    return Split([], [_hollow(points, faces, Detail.HULL)])


def _hull_is_close(points: _Points, faces: _Faces) -> bool:
    hull = hull_of(points[np.unique(faces)])
    return hull is not None and distance(hull.triangles, points[faces]) < _CLOSE


def _hollow(points: _Points, faces: _Faces, detail: Detail) -> tuple[_Points, HollowPart]:
    own = points[np.unique(faces)]
    lowest = own.min(axis=0)
    return lowest, HollowPart(np.round((own - lowest) / WELD) * WELD, renumbered(faces), detail)


def cut_part(part: HollowPart) -> ConvexPieces:
    """Find what stands for a hollow part: pieces, or its hull."""
    points, faces = part.points, part.faces
    hull = hull_of(points)
    triangles, closed = points[faces], is_closed(faces)
    if hull is None:
        return _flat(points, faces, triangles)
    own_volume = volume_of(triangles) if closed else 0.0
    times = hull.volume / own_volume if own_volume > 0 else None
    misfit = HullError(times, distance(hull.triangles, triangles), is_filled=True)
    is_hollow = misfit.away > _HOLLOW * float(np.ptp(points, axis=0).max()) and not (times and times < _FULL)
    if part.detail is not Detail.HULL and is_hollow:
        cut = decompose(points, faces, hull, closed=closed, coarse=part.detail is Detail.COARSE) or []
        solids = [solid for piece in cut if (solid := hull_of(piece)) is not None]
        volume, away = sum(solid.volume for solid in solids), surface_error(triangles, solids, closed=closed)
        if volume < hull.volume / _FULL and away < misfit.away:
            return ConvexPieces(cut, [HullError(volume / own_volume if times else None, away, is_filled=False)])
    return ConvexPieces([points], [misfit])


def filled(part: HollowPart) -> ConvexPieces:
    """The hull of a part; how far it is off, where it has one."""
    return cut_part(replace(part, detail=Detail.HULL))


def _flat(points: _Points, faces: _Faces, triangles: _Points) -> ConvexPieces:
    """One layer of it, or thin walls where it is not convex."""
    walls = shell_pieces(points, faces, closed=False) if len(faces) <= _MOST_FLAT else []
    if len(walls) < 2:
        return ConvexPieces([points], [])
    solids = [solid for wall in walls if (solid := hull_of(wall)) is not None]
    return ConvexPieces(walls, [HullError(None, surface_error(triangles, solids, closed=False), is_filled=False)])
