"""Slabs behind the faces of what stands: a hollow mesh, exactly."""

import numpy as np
from numpy.typing import NDArray

from .hulls import area_around
from .surface_parts import WELD, islands_of

_Points = NDArray[np.float64]
_Faces = NDArray[np.intp]
_THICKEST = 0.01
"""[m] Of a slab: what comes at 10 m/s still meets it in a step of 1 ms."""
_THINNEST = 1e-4
"""[m] What is thinner is flat."""


def is_layer(own: _Points) -> bool:
    """Whether points (N, 3) are flat."""
    centred = own - own.mean(axis=0)
    return bool(np.ptp(centred @ np.linalg.eigh(centred.T @ centred)[1][:, 0]) < _THINNEST)


def slabs_of(points: _Points, faces: _Faces, own: _Points) -> list[_Points]:
    """A slab behind each flat face; faces that make one convex polygon share one."""
    sides = np.ptp(own, axis=0)
    thickness = float(np.clip(sides[sides > WELD].min(initial=_THICKEST) / 4, 1e-3, _THICKEST))
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
        islands = islands_of(len(points), flat)[flat[:, 0]]
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
