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

from .decomposition import MAX_FACES, MAX_SHEETED, decompose, is_thin
from .face_slabs import is_convex_layer, is_layer, slabs_of
from .hulls import hausdorff_distance, hull_of, surface_error, volume_of
from .mesh_components import WELD, connected_components, is_closed, is_convex, renumbered, welded
from .shell_decomposition import shell_pieces

_Points = NDArray[np.float64]
_Faces = NDArray[np.intp]
MAX_PIECES = 1000
"""Beyond so many, a mesh that moves is one convex hull."""
MAX_SLABS = 50_000
"""Slabs of all that stands in a world; a later mesh of more than 1000 is one hull."""
_CLOSE = 0.02
"""[m] Where its hull is nearer, what stands and takes over 1000 slabs is its hull."""
_VERSION = 4
"""Raised where the same mesh becomes other pieces."""
_HOLLOW = 0.05
"""Part of its size by which the hull of something hollow may be away from it, and it is filled all the same."""
_FULL = 1.1
"""Times its volume that a hull may have, and it is filled all the same."""
_MAX_CUT = 8
"""Parts of a mesh that are cut up, the largest first."""
_MAX_FLAT = 2000
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

    volume_ratio: float | None
    """Its volume over the mesh's; None where the mesh is open and has none."""
    distance: float
    """[m] How far the two surfaces are from one another at most."""
    is_filled: bool
    """Whether something hollow was made solid."""


class ConvexPieces(Struct, frozen=True):
    """Convex pieces of a mesh."""

    corners: list[_Points]
    """(N, 3) of each; its hull is the piece."""
    errors: list[HullError]
    """One for each part that is not what it is in the mesh."""


class ConcavePart(Struct, frozen=True, eq=False):
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
        if self.detail is Detail.HULL or count > MAX_FACES:
            return 0.05
        if self.detail is Detail.COARSE:
            return 0.3 + 2e-5 * count
        size = float(np.ptp(self.points, axis=0).max())
        is_shell = count <= MAX_SHEETED and (not is_closed(self.faces) or is_thin(self.points[self.faces], size))
        return 0.5 + (1e-3 if is_shell else 5e-5) * count


class MeshSplit(Struct, frozen=True):
    """A mesh before its hollow parts are cut."""

    corners: list[_Points]
    """(N, 3) of each convex piece [m]."""
    concave: list[tuple[_Points, ConcavePart]]
    """Each with where its lowest corner is (3,) [m]; the largest first."""


def split_mesh(vertices: _Points, faces: _Faces, *, fixed: bool) -> MeshSplit:
    """Find the convex pieces of a mesh, and what is hollow.

    Args:
        vertices: (N, 3) [m].
        faces: (M, 3) indices into them, counter-clockwise from outside.
        fixed: it never moves.
    """
    points, faces = welded(vertices, faces)
    if not len(faces):
        return MeshSplit([vertices], [])
    labels = connected_components(len(points), faces)[faces[:, 0]]
    order = np.argsort(labels, kind="stable")
    starts = np.flatnonzero(np.diff(labels[order])) + 1
    corners: list[_Points] = []
    concave: list[_Faces] = []
    for component in np.split(faces[order], starts):
        own = points[np.unique(component)]
        if fixed and (is_layer(own) or not is_convex(points, component, own)):
            corners += slabs_of(points, component, own)
        elif fixed or is_convex(points, component, own) or is_convex_layer(points, component, own):
            corners.append(own)
        else:
            concave.append(component)
        if len(corners) + len(concave) > (MAX_SLABS if fixed else MAX_PIECES):
            return as_single_hull(points, faces)
    if len(corners) > MAX_PIECES and _hull_is_close(points, faces):
        return as_single_hull(points, faces)
    concave.sort(key=lambda component: -float(np.prod(np.ptp(points[np.unique(component)], axis=0))))
    details = [Detail.FULL if i < _MAX_CUT else Detail.HULL for i in range(len(concave))]
    return MeshSplit(
        corners, [_concave_part(points, component, detail) for component, detail in zip(concave, details, strict=True)]
    )


def as_single_hull(vertices: _Points, faces: _Faces) -> MeshSplit:
    """Leave a mesh whole, which fills it."""
    points, faces = welded(vertices, faces)
    return MeshSplit([], [_concave_part(points, faces, Detail.HULL)])


def _hull_is_close(points: _Points, faces: _Faces) -> bool:
    hull = hull_of(points[np.unique(faces)])
    return hull is not None and hausdorff_distance(hull.triangles, points[faces]) < _CLOSE


def _concave_part(points: _Points, faces: _Faces, detail: Detail) -> tuple[_Points, ConcavePart]:
    own = points[np.unique(faces)]
    lowest = own.min(axis=0)
    return lowest, ConcavePart(np.round((own - lowest) / WELD) * WELD, renumbered(faces), detail)


def decompose_part(part: ConcavePart) -> ConvexPieces:
    """Find what stands for a hollow part: pieces, or its hull."""
    points, faces = part.points, part.faces
    hull = hull_of(points)
    triangles, closed = points[faces], is_closed(faces)
    if hull is None:
        return _flat(points, faces, triangles)
    own_volume = volume_of(triangles) if closed else 0.0
    times = hull.volume / own_volume if own_volume > 0 else None
    error = HullError(times, hausdorff_distance(hull.triangles, triangles), is_filled=True)
    is_hollow = error.distance > _HOLLOW * float(np.ptp(points, axis=0).max()) and not (times and times < _FULL)
    if part.detail is not Detail.HULL and is_hollow:
        cut = decompose(points, faces, hull, closed=closed, coarse=part.detail is Detail.COARSE) or []
        solids = [solid for piece in cut if (solid := hull_of(piece)) is not None]
        volume, away = sum(solid.volume for solid in solids), surface_error(triangles, solids, closed=closed)
        if volume < hull.volume / _FULL and away < error.distance:
            return ConvexPieces(cut, [HullError(volume / own_volume if times else None, away, is_filled=False)])
    return ConvexPieces([points], [error])


def hull_of_part(part: ConcavePart) -> ConvexPieces:
    """The hull of a part; how far it is off, where it has one."""
    return decompose_part(replace(part, detail=Detail.HULL))


def _flat(points: _Points, faces: _Faces, triangles: _Points) -> ConvexPieces:
    """One layer of it, or thin walls where it is not convex."""
    walls = shell_pieces(points, faces, closed=False) if len(faces) <= _MAX_FLAT else []
    if len(walls) < 2:
        return ConvexPieces([points], [])
    solids = [solid for wall in walls if (solid := hull_of(wall)) is not None]
    return ConvexPieces(walls, [HullError(None, surface_error(triangles, solids, closed=False), is_filled=False)])
