"""Test whether a closed mesh is convex, in a time that grows with its edges."""

from collections.abc import Callable

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from .hulls import hull_of

_Points = NDArray[np.float64]
_Faces = NDArray[np.intp]
_DENT = 2e-3
"""Depth of a dent, relative to the size, up to which a mesh counts as convex."""
_FEW = 64
"""Faces whose planes are compared with every point."""
_MANY = 4096
"""Faces whose planes are compared with a hull at once."""
_NEAR = 1e-6
"""Distance of a face's plane from the middle, relative to the largest, up to which the middle is not inside."""
_STARTS = 512
"""Corners of a hull that are compared; the climb to the highest starts at the best."""


def is_convex(points: _Points, faces: _Faces, vertices: _Points) -> bool:
    """True if the faces form a closed convex body.

    Single faces may be flipped, as in many published meshes; with all of them flipped it is a room seen from inside.

    Args:
        points: (N, 3) [m].
        faces: (M, 3) indices into points, none without area.
        vertices: points used by the faces.
    """
    sides = _sides_by_edge(faces)
    if sides is None:
        return False
    dent = _DENT * float(np.ptp(vertices, axis=0).max())
    middle = vertices.mean(axis=0)
    points, vertices = points - middle, vertices - middle
    a, b, c = (points[faces[:, i]] for i in range(3))
    normals = np.cross(b - a, c - a)
    normals /= np.sqrt(np.einsum("ij,ij->i", normals, normals))[:, None]
    offsets = np.einsum("ij,ij->i", normals, a)
    if (offsets > 0).any() and _fold_height(points, faces, normals, offsets, sides) <= dent:
        return True
    return _are_heights_within(dent, normals, offsets, vertices)


def _sides_by_edge(faces: _Faces) -> _Faces | None:
    """Return (E, 2) indices into the faces' 3 M sides, two for each edge; None if an edge has another number."""
    starts, ends = faces.ravel(), np.roll(faces, -1, axis=1).ravel()
    keys = np.minimum(starts, ends) * (int(faces.max()) + 1) + np.maximum(starts, ends)
    order = np.argsort(keys, kind="stable")
    if len(order) % 2:
        return None
    sides = order.reshape(-1, 2)
    keys = keys[sides]
    is_closed = (keys[:, 0] == keys[:, 1]).all() and (keys[1:, 0] != keys[:-1, 0]).all()
    return sides if is_closed else None


def _fold_height(points: _Points, faces: _Faces, normals: _Points, offsets: _Points, sides: _Faces) -> float:
    """Return a bound of the height of any point above any face [m], by the folds between neighbours; infinite if there
    is none.

    A surface that surrounds the origin once is the graph of a function of the direction: 1 on the surface, linear in
    each face's cone, and convex if convex across every edge. Otherwise its excess at a point is at most the sum of the
    excesses of the edges on the way to it.

    Args:
        points: (N, 3) about a point inside [m].
        faces: (M, 3) indices into points.
        normals: (M, 3) unit normals of the faces.
        offsets: (M,) distances of the faces from the origin along their normals [m].
        sides: (E, 2) result of `_sides_by_edge`.
    """
    heights = np.abs(offsets)
    if heights.min() <= _NEAR * heights.max():
        return np.inf
    starts, ends = faces.ravel()[sides].T
    first, second = sides.T // 3
    is_flipped = offsets < 0
    is_first_flipped = is_flipped[first]
    if ((starts == ends) ^ is_first_flipped ^ is_flipped[second]).any() or _faces_on_a_ray(points, faces) != 1:
        return np.inf
    ends = np.roll(faces, -1, axis=1).ravel()[sides[:, 0]]
    gradients = normals / offsets[:, None]
    across = np.cross(points[starts], points[ends])
    lengths = np.sqrt(np.einsum("ij,ij->i", across, across))
    folds = np.einsum("ij,ij->i", gradients[second] - gradients[first], across) / lengths
    excess = float(np.maximum(np.where(is_first_flipped, -folds, folds), 0).sum())
    return excess * float(np.sqrt(np.einsum("ij,ij->i", points, points).max()) * heights.max())


def _faces_on_a_ray(points: _Points, faces: _Faces) -> int:
    """Return the number of faces that the ray from the origin through the middle of the first face meets."""
    ray = points[faces[0]].mean(axis=0)
    right = np.cross(ray, [1.0, 0.0, 0.0] if abs(ray[0]) < 0.9 * np.linalg.norm(ray) else [0.0, 1.0, 0.0])
    a, b, c = ((points @ np.column_stack([right, np.cross(ray, right), ray]))[faces[:, i]] for i in range(3))
    turns = np.array([u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0] for u, v in ((a, b), (b, c), (c, a))])
    is_ahead = (a[:, 2] > 0) & (b[:, 2] > 0) & (c[:, 2] > 0)
    return int(np.count_nonzero(((turns >= 0).all(axis=0) | (turns <= 0).all(axis=0)) & is_ahead))


def _are_heights_within(dent: float, normals: _Points, offsets: _Points, vertices: _Points) -> bool:
    """True if the points lie on one side of each face, within a dent [m], and below at least one face."""
    step = -(-len(normals) // _FEW)
    subset = slice(None, None, step)  # spread over the surface, as most dents are seen from many faces
    is_within, has_outside = _compare(
        dent, normals[subset], offsets[subset], lambda along: (along @ vertices.T).max(axis=1)
    )
    if not is_within or step == 1:
        return is_within and has_outside
    graph = _HullGraph.around(vertices)
    if graph is None:  # flat: all faces are in one plane
        return has_outside
    for first in range(0, len(normals), _MANY):
        subset = slice(first, first + _MANY)
        is_within, is_outside = _compare(dent, normals[subset], offsets[subset], graph.highest)
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


class _HullGraph(Struct, frozen=True):
    """Corners of a hull and their neighbours; a climb over neighbours finds the highest corner."""

    corners: _Points
    neighbours: _Faces
    """Neighbours of all corners, in order of the corners."""
    firsts: _Faces
    """(C,) index of each corner's first neighbour."""
    counts: _Faces

    @classmethod
    def around(cls, points: _Points) -> "_HullGraph | None":
        """Return the graph of the hull of points (N, 3) [m]; None if they are flat."""
        hull = hull_of(points)
        if hull is None:
            return None
        counts = np.bincount(hull.faces.ravel(), minlength=len(hull.corners))
        order = np.argsort(hull.faces.ravel(), kind="stable")
        neighbours = np.roll(hull.faces, -1, axis=1).ravel()[order]  # each edge once in each direction
        return cls(hull.corners, neighbours, np.cumsum(counts) - counts, counts)

    def highest(self, directions: _Points) -> _Points:
        """Return (D,) the largest heights of the corners along directions (D, 3) [m], by climbing from corner to
        corner.
        """
        samples = np.arange(0, len(self.corners), -(-len(self.corners) // _STARTS))
        heights = directions @ self.corners[samples].T
        at, best = samples[heights.argmax(axis=1)], heights.max(axis=1)
        climbing = np.arange(len(directions))
        while len(climbing):
            counts = self.counts[at[climbing]]
            starts = np.cumsum(counts) - counts
            rank = np.arange(counts.sum()) - np.repeat(starts, counts)
            neighbours = self.neighbours[np.repeat(self.firsts[at[climbing]], counts) + rank]
            heights = np.einsum("ij,ij->i", np.repeat(directions[climbing], counts, axis=0), self.corners[neighbours])
            tops = np.maximum.reduceat(heights, starts)
            is_higher = tops > best[climbing]
            is_top = np.flatnonzero(heights == np.repeat(np.where(is_higher, tops, np.inf), counts))
            owners, firsts = np.unique(np.repeat(np.arange(len(climbing)), counts)[is_top], return_index=True)
            climbing = climbing[owners]
            at[climbing], best[climbing] = neighbours[is_top[firsts]], tops[owners]
        return best
