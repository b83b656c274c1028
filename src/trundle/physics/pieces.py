"""Concave meshes as convex pieces, which is all that MuJoCo can touch.

What hangs together in a mesh is one piece if it is convex. If it is not, and never moves, each flat face of it becomes
a slab as thick as a wall may be: so a room can be entered, and a ramp driven up. What moves is its convex hull.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

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


@dataclass(frozen=True, slots=True)
class Pieces:
    """Convex pieces of a mesh."""

    corners: list[_Points]
    """(N, 3) of each; its hull is the piece."""
    is_exact: bool
    """Whether nothing hollow was filled."""


def convex_pieces(vertices: _Points, faces: _Faces, *, fixed: bool) -> Pieces:
    """Cut a mesh up.

    Args:
        vertices: (N, 3) [m].
        faces: (M, 3) indices into them, counter-clockwise from outside.
        fixed: it never moves.
    """
    points, faces = _welded(vertices, faces)
    if not len(faces):
        return Pieces([vertices], True)
    labels = _islands(len(points), faces)[faces[:, 0]]
    order = np.argsort(labels, kind="stable")
    starts = np.flatnonzero(np.diff(labels[order])) + 1
    corners: list[_Points] = []
    exact = True
    for island in np.split(faces[order], starts):
        own = points[np.unique(island)]
        if fixed and (_is_flat(own) or not _is_convex(points, island, own)):
            corners += _slabs(points, island, own)
        elif fixed or _is_convex(points, island, own):
            corners.append(own)
        else:
            corners.append(own)
            exact = False
        if len(corners) > MOST_PIECES:
            return Pieces([points], False)
    return Pieces(corners, exact)


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
            if _hull_area(corners, normal) <= areas[members].sum() / 2 * 1.01:
                slabs.append(np.concatenate([corners, corners - normal * thickness]))
            else:
                triangles = points[faces[members]]
                slabs += [np.concatenate([triangle, triangle - normal * thickness]) for triangle in triangles]
    return slabs


def _hull_area(corners: _Points, normal: _Points) -> float:
    """Of the convex polygon around points in a plane: Andrew's monotone chain."""
    across = np.cross(normal, [1.0, 0.0, 0.0] if abs(normal[0]) < 0.9 else [0.0, 1.0, 0.0])
    across /= np.linalg.norm(across)
    flat = np.column_stack([corners @ across, corners @ np.cross(normal, across)])
    flat = flat[np.lexsort((flat[:, 1], flat[:, 0]))]

    def chain(points: list[list[float]]) -> list[list[float]]:
        kept: list[list[float]] = []
        for x, y in points:
            while len(kept) > 1:
                (x0, y0), (x1, y1) = kept[-2:]
                if (x1 - x0) * (y - y0) - (y1 - y0) * (x - x0) > 0:
                    break
                kept.pop()
            kept.append([x, y])
        return kept[:-1]

    hull = np.array(chain(flat.tolist()) + chain(flat[::-1].tolist()))
    x, y = hull.T
    return abs(float(x @ np.roll(y, -1) - y @ np.roll(x, -1))) / 2
