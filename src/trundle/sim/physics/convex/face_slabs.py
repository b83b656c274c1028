"""Slabs behind the faces of fixed meshes: concave surfaces without error."""

import numpy as np
from numpy.typing import NDArray

from trundle.robots.meshes import component_labels

from .hulls import convex_hull_area
from .mesh_faces import WELD
from .patches import convex_patches

_Points = NDArray[np.float64]
_Faces = NDArray[np.intp]
_THICKEST = 2.5e-3
"""Largest slab thickness [m], less than any wall but sheet metal; see `tunnelling` for small fast bodies."""
_THINNEST = 1e-4
"""Thickness below which a mesh is flat [m]."""
_FILLS = 1.001
"""Largest ratio of a convex polygon's area to that of the faces that fill it."""


def is_layer(points: _Points) -> bool:
    """True if points (N, 3) are flat."""
    centred = points - points.mean(axis=0)
    return bool(np.ptp(centred @ np.linalg.eigh(centred.T @ centred)[1][:, 0]) < _THINNEST)


def is_convex_layer(points: _Points, faces: _Faces, vertices: _Points) -> bool:
    """True if faces are flat and fill their convex polygon; faces present in both orientations count once."""
    if not is_layer(vertices):
        return False
    a, b, c = (points[np.unique(np.sort(faces, axis=1), axis=0)[:, i]] for i in range(3))
    normals = np.cross(b - a, c - a)
    areas = np.linalg.norm(normals, axis=1)
    widest = int(areas.argmax())
    return convex_hull_area(vertices, normals[widest] / areas[widest]) <= areas.sum() / 2 * _FILLS


def slabs_of(points: _Points, faces: _Faces, vertices: _Points) -> list[_Points]:
    """Return corners (N, 3) of slabs behind all faces [m]; faces that form a convex polygon or bulge share one.

    Args:
        points: (N, 3) [m].
        faces: (M, 3) indices into points, none without area.
        vertices: points used by the faces.
    """
    sides = np.ptp(vertices, axis=0)
    thickness = float(np.clip(sides[sides > WELD].min(initial=np.inf) / 4, 1e-3, _THICKEST))
    a, b, c = (points[faces[:, i]] for i in range(3))
    normals = np.cross(b - a, c - a)
    areas = np.linalg.norm(normals, axis=1)
    normals /= areas[:, None]
    slabs: list[_Points] = []
    is_left = np.ones(len(faces), dtype=bool)
    for members in _polygons(faces, normals, np.einsum("ij,ij->i", normals, a)):
        normal = normals[members[0]]
        corners = points[np.unique(faces[members])]
        if convex_hull_area(corners, normal) <= areas[members].sum() / 2 * 1.01:
            slabs.append(np.concatenate([corners, corners - normal * thickness]))
            is_left[members] = False
    patches = convex_patches(points, faces[is_left], depth=thickness)
    lengths = np.linalg.norm(patches.normals, axis=1, keepdims=True)
    inward = patches.normals / np.maximum(lengths, np.finfo(float).tiny) * thickness
    for loop, size, depth in zip(patches.loops, patches.sizes.tolist(), inward, strict=True):
        corners = points[loop[:size]]
        slabs.append(np.concatenate([corners, corners - depth]))
    return slabs


def _polygons(faces: _Faces, normals: _Points, offsets: _Points) -> list[_Faces]:
    """Return the indices of connected coplanar faces, for groups of several."""
    keys = np.round(np.column_stack([normals, offsets]), 4)
    planes = np.unique(keys, axis=0, return_inverse=True)[1].reshape(-1)
    # Corners are numbered per plane, so that faces of different planes are not connected over an edge.
    corners, numbered = np.unique(faces + planes[:, None] * (int(faces.max()) + 1), return_inverse=True)
    numbered = numbered.reshape(faces.shape)
    labels = component_labels(len(corners), numbered)[numbered[:, 0]]
    order = np.argsort(labels, kind="stable")
    starts = np.flatnonzero(np.diff(labels[order])) + 1
    return [members for members in np.split(order, starts) if len(members) > 1]
