"""Convex pieces of concave meshes, because MuJoCo's contacts are convex.

A convex component of a mesh is one piece. Each flat face of a fixed concave one becomes a thin slab, so that rooms can
be entered and ramps driven up. A moving one is decomposed into a few nearly convex pieces if it is truly concave;
otherwise, or if the pieces are no better, its hull replaces it.
"""

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from trundle.robots.meshes import component_labels, double_areas, unique_rows

from .convexity import is_convex
from .face_slabs import is_convex_layer, is_layer, slabs_of
from .hulls import hausdorff_distance, hull_of
from .mesh_faces import WELD, renumbered, used_points
from .pieces import ConcavePart, Detail
from .simplification import MAX_CORNERS, simplify

_Points = NDArray[np.float64]
_Faces = NDArray[np.intp]
MAX_PIECES = 1000
"""Maximum number of pieces of a moving mesh; with more, it becomes one hull."""
MAX_SLABS = 50_000
"""Maximum number of slabs of all fixed meshes of a world; with more, each mesh of over 1000 slabs becomes one hull."""
_CLOSE = 0.02
"""Distance of the hull [m] up to which it replaces a fixed mesh of over 1000 slabs."""
_MAX_CUT = 8
"""Maximum number of parts of a mesh that are decomposed, largest first."""
_SMALL = 0.1
"""Thickness of a part, relative to the mesh's size, up to which its hull replaces it: screws of a casing, for example.
Its cross-sections lie within the thickness, and the part is in each of them, so no point of the hull is farther away.
"""


class MeshSplit(Struct, frozen=True):
    """Mesh split into convex pieces and concave parts."""

    corners: list[_Points]
    """(N, 3) corners of each convex piece [m]."""
    concave: list[tuple[_Points, ConcavePart]]
    """(3,) lowest corner [m] and part, largest first."""
    simplified_by: float = 0.0
    """Largest distance of a convex piece's surface from the mesh's, if not all corners are used [m]."""


def split_mesh(vertices: _Points, faces: _Faces, *, fixed: bool) -> MeshSplit:
    """Split a mesh into convex pieces and concave parts.

    Args:
        vertices: (N, 3) [m].
        faces: (M, 3) indices into vertices, counter-clockwise from outside.
        fixed: True if the mesh never moves.
    """
    points, faces = _welded(vertices, faces)
    if not len(faces):
        return MeshSplit([vertices], [])
    labels = component_labels(len(points), faces)[faces[:, 0]]
    order = np.argsort(labels, kind="stable")
    starts = np.flatnonzero(np.diff(labels[order])) + 1
    corners: list[_Points] = []
    concave: list[_Faces] = []
    simplified_by = 0.0
    for component in np.split(faces[order], starts):
        vertices_of_component = points[used_points(component)]
        if fixed and (is_layer(vertices_of_component) or not is_convex(points, component, vertices_of_component)):
            corners += slabs_of(points, component, vertices_of_component)
        elif (
            fixed
            or is_convex(points, component, vertices_of_component)
            or is_convex_layer(points, component, vertices_of_component)
        ):
            simplified = None
            if len(vertices_of_component) > MAX_CORNERS:
                simplified = simplify(points, component)
            if simplified is not None:
                vertices_of_component = simplified.corners
                simplified_by = max(simplified_by, simplified.distance)
            corners.append(vertices_of_component)
        else:
            concave.append(component)
        if len(corners) + len(concave) > (MAX_SLABS if fixed else MAX_PIECES):
            return as_single_hull(points, faces)
    if len(corners) > MAX_PIECES and _hull_is_close(points, faces):
        return as_single_hull(points, faces)
    concave.sort(key=lambda component: -float(np.prod(np.ptp(points[np.unique(component)], axis=0))))
    small = _SMALL * float(np.ptp(points[np.unique(faces)], axis=0).max())
    details = [
        Detail.FULL if i < _MAX_CUT and _thickness(points, component) > small else Detail.HULL
        for i, component in enumerate(concave)
    ]
    parts = [_concave_part(points, component, detail) for component, detail in zip(concave, details, strict=True)]
    return MeshSplit(corners, parts, simplified_by)


def as_single_hull(vertices: _Points, faces: _Faces) -> MeshSplit:
    """Return a mesh as a single part, replaced by its hull."""
    points, faces = _welded(vertices, faces)
    return MeshSplit([], [_concave_part(points, faces, Detail.HULL)])


def _thickness(points: _Points, faces: _Faces) -> float:
    """Return the diagonal of a part's box across its longest side [m]."""
    return float(np.linalg.norm(np.sort(np.ptp(points[np.unique(faces)], axis=0))[:2]))


def _hull_is_close(points: _Points, faces: _Faces) -> bool:
    hull = hull_of(points[np.unique(faces)])
    return hull is not None and hausdorff_distance(hull.triangles, points[faces]) < _CLOSE


def _concave_part(points: _Points, faces: _Faces, detail: Detail) -> tuple[_Points, ConcavePart]:
    vertices = points[np.unique(faces)]
    lowest = vertices.min(axis=0)
    return lowest, ConcavePart(np.round((vertices - lowest) / WELD) * WELD, renumbered(faces), detail)


def _welded(vertices: _Points, faces: _Faces) -> tuple[_Points, _Faces]:
    """Return points with duplicates merged, and faces without degenerate ones."""
    first, number = unique_rows(np.round(vertices / WELD))
    points, faces = vertices[first], number[faces]
    return points, faces[double_areas(points, faces) > 1e-12]
