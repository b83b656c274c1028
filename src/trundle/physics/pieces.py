"""Concave meshes as convex pieces, which is all that MuJoCo can touch.

What hangs together in a mesh is one piece if it is convex. If it is not, and never moves, each flat face of it becomes
a slab as thick as a wall may be: so a room can be entered, and a ramp driven up. What moves is cut into a few nearly
convex pieces if it is truly hollow; else, and where that makes nothing better, it is filled.
"""

import hashlib
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .decompose import cut_up
from .hulls import area_around, distance, hull_of, off, volume_of
from .sheets import sheets_of

_Points = NDArray[np.float64]
_Faces = NDArray[np.intp]
MOST_PIECES = 1000
"""Beyond so many, a mesh is one convex hull."""
_THICKEST = 0.01
"""[m] Of a slab: what comes at 10 m/s still meets it in a step of 1 ms."""
_THINNEST = 1e-4
"""[m] What is thinner is flat."""
_WELD = 1e-6
"""[m] Corners nearer than this are one."""
_DENT = 2e-3
"""Part of its size by which a piece may be hollow and still count as convex."""


_HOLLOW = 0.05
"""Part of its size by which the hull of something hollow may be away from it, and it is filled all the same."""
_FULL = 1.1
"""Times its volume that a hull may have, and it is filled all the same."""
_MOST_CUT = 8
"""Parts of a mesh that are cut up, the largest first."""
_MOST_FLAT = 2000
"""Faces of something flat that is cut up."""
_MOST_KNOWN = 256


@dataclass(frozen=True, slots=True)
class Misfit:
    """How what is simulated differs from a mesh that is hollow."""

    times: float | None
    """Its volume over the mesh's; None where the mesh is open and has none."""
    away: float
    """[m] How far the two surfaces are from one another at most."""
    is_filled: bool
    """Whether something hollow was made solid."""


@dataclass(frozen=True, slots=True)
class Pieces:
    """Convex pieces of a mesh."""

    corners: list[_Points]
    """(N, 3) of each; its hull is the piece."""
    misfits: list[Misfit]
    """One for each part that is not what it is in the mesh."""


_known: dict[bytes, Pieces] = {}
"""By what they were cut from; the longest unused first."""


def convex_pieces(vertices: _Points, faces: _Faces, *, fixed: bool) -> Pieces:
    """Cut a mesh up, or remember how: whenever a model comes or goes, the whole world is compiled anew.

    Args:
        vertices: (N, 3) [m].
        faces: (M, 3) indices into them, counter-clockwise from outside.
        fixed: it never moves.
    """
    digest = hashlib.sha256(b"%d %d " % (fixed, len(vertices)) + vertices.tobytes() + faces.tobytes()).digest()
    found = _known.pop(digest, None) or _cut_up(vertices, faces, fixed=fixed)
    _known[digest] = found
    if len(_known) > _MOST_KNOWN:
        del _known[next(iter(_known))]
    return found


def _cut_up(vertices: _Points, faces: _Faces, *, fixed: bool) -> Pieces:
    points, faces = _welded(vertices, faces)
    if not len(faces):
        return Pieces([vertices], [])
    labels = _islands(len(points), faces)[faces[:, 0]]
    order = np.argsort(labels, kind="stable")
    starts = np.flatnonzero(np.diff(labels[order])) + 1
    corners: list[_Points] = []
    hollow: list[_Faces] = []
    for island in np.split(faces[order], starts):
        own = points[np.unique(island)]
        if fixed and (_is_flat(own) or not _is_convex(points, island, own)):
            corners += _slabs(points, island, own)
        elif fixed or _is_convex(points, island, own):
            corners.append(own)
        else:
            hollow.append(island)
        if len(corners) + len(hollow) > MOST_PIECES:
            return _filled(points, faces)
    pieces = Pieces(corners, [])
    hollow.sort(key=lambda island: -float(np.prod(np.ptp(points[np.unique(island)], axis=0))))
    for i, island in enumerate(hollow):
        taken = _taken_for(points[np.unique(island)], _renumbered(island), may_cut=i < _MOST_CUT)
        pieces.corners.extend(taken.corners)
        pieces.misfits.extend(taken.misfits)
    return pieces


def _filled(points: _Points, faces: _Faces) -> Pieces:
    return _taken_for(points[np.unique(faces)], _renumbered(faces), may_cut=False)


def _taken_for(points: _Points, faces: _Faces, *, may_cut: bool) -> Pieces:
    """What stands for a hollow part: pieces, or its hull."""
    hull = hull_of(points)
    triangles, closed = points[faces], _is_closed(faces)
    if hull is None:
        return _flat(points, faces, triangles)
    own_volume = volume_of(triangles) if closed else 0.0
    times = hull.volume / own_volume if own_volume > 0 else None
    misfit = Misfit(times, distance(hull.triangles, triangles), is_filled=True)
    if may_cut and misfit.away > _HOLLOW * float(np.ptp(points, axis=0).max()) and not (times and times < _FULL):
        cut = cut_up(points, faces, hull, closed=closed) or []
        solids = [solid for piece in cut if (solid := hull_of(piece)) is not None]
        volume, away = sum(solid.volume for solid in solids), off(triangles, solids, closed=closed)
        if volume < hull.volume / _FULL and away < misfit.away:
            return Pieces(cut, [Misfit(volume / own_volume if times else None, away, is_filled=False)])
    return Pieces([points], [misfit])


def _flat(points: _Points, faces: _Faces, triangles: _Points) -> Pieces:
    """One layer of it, or thin walls where it is not convex."""
    walls = sheets_of(points, faces, closed=False) if len(faces) <= _MOST_FLAT else []
    if len(walls) < 2:
        return Pieces([points], [])
    solids = [solid for wall in walls if (solid := hull_of(wall)) is not None]
    return Pieces(walls, [Misfit(None, off(triangles, solids, closed=False), is_filled=False)])


def _is_closed(faces: _Faces) -> bool:
    """Whether each edge is there once each way."""
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    once = len(np.unique(edges, axis=0)) == len(edges)
    return once and len(np.unique(np.concatenate([edges, edges[:, ::-1]]), axis=0)) == len(edges)


def _renumbered(faces: _Faces) -> _Faces:
    """Faces of the corners that they use, in their order."""
    return np.unique(faces, return_inverse=True)[1].reshape(faces.shape)


def _welded(vertices: _Points, faces: _Faces) -> tuple[_Points, _Faces]:
    """Corners that are one made one, faces without area left out."""
    _, first, number = np.unique(np.round(vertices / _WELD), axis=0, return_index=True, return_inverse=True)
    points, faces = vertices[first], number.reshape(-1)[faces]
    a, b, c = (points[faces[:, i]] for i in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    return points, faces[area > 1e-12]


def _islands(count: int, faces: _Faces) -> _Faces:
    """For each corner the smallest number of a corner that it hangs together with."""
    labels = np.arange(count)
    while True:
        smallest = labels[faces].min(axis=1)
        new = labels.copy()
        np.minimum.at(new, faces.ravel(), np.repeat(smallest, 3))
        new = new[new]
        if np.array_equal(new, labels):
            return labels
        labels = new


def _is_convex(points: _Points, faces: _Faces, own: _Points) -> bool:
    """Whether the faces close a body, and every corner is on one side of each of them.

    Some faces may be turned, as in many a published mesh; where all are, it is a room seen from inside.
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


def _is_flat(own: _Points) -> bool:
    centred = own - own.mean(axis=0)
    return bool(np.ptp(centred @ np.linalg.eigh(centred.T @ centred)[1][:, 0]) < _THINNEST)


def _slabs(points: _Points, faces: _Faces, own: _Points) -> list[_Points]:
    """A slab behind each flat face; faces that make one convex polygon share one."""
    sides = np.ptp(own, axis=0)
    thickness = float(np.clip(sides[sides > _WELD].min(initial=_THICKEST) / 4, 1e-3, _THICKEST))
    a, b, c = (points[faces[:, i]] for i in range(3))
    normals = np.cross(b - a, c - a)
    areas = np.linalg.norm(normals, axis=1)
    normals /= areas[:, None]
    keys = np.round(np.column_stack([normals, np.einsum("ij,ij->i", normals, a)]), 4)
    slabs: list[_Points] = []
    _, planes = np.unique(keys, axis=0, return_inverse=True)
    planes = planes.reshape(-1)
    for plane in range(int(planes.max()) + 1):
        chosen = np.flatnonzero(planes == plane)
        flat = faces[chosen]
        islands = _islands(len(points), flat)[flat[:, 0]]
        for island in np.unique(islands):
            members = chosen[islands == island]
            normal = normals[members[0]]
            corners = points[np.unique(faces[members])]
            if area_around(corners, normal) <= areas[members].sum() / 2 * 1.01:
                slabs.append(np.concatenate([corners, corners - normal * thickness]))
            else:
                triangles = points[faces[members]]
                slabs += [np.concatenate([triangle, triangle - normal * thickness]) for triangle in triangles]
    return slabs
