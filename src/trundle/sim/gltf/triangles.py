"""Indexed triangles: a mesh's values per face corner become values per vertex."""

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from trundle.robots.meshes import Mesh

_MIX = (0x9E3779B97F4A7C15, 0xBF58476D1CE4E5B9, 0x94D049BB133111EB)
"""Odd multipliers of splitmix64 (Steele, Lea, Flood 2014)."""
_UP = np.array([0.0, 0.0, 1.0], dtype=np.float32)


class Binding(Struct, frozen=True, eq=False, kw_only=True):
    """Bones that deform each of N vertices."""

    bones: NDArray[np.uint16]
    """(N, 4) indices of the skin's bones."""
    weights: NDArray[np.float32]
    """(N, 4); each row's sum is 1."""


class Triangles(Struct, frozen=True, eq=False, kw_only=True):
    """Indexed triangles in glTF's layout, with z up."""

    positions: NDArray[np.float32]
    """(N, 3) [m]"""
    indices: NDArray[np.uint32]
    """(M, 3), counter-clockwise from outside."""
    normals: NDArray[np.float32] | None = None
    """(N, 3) unit vectors; None: flat faces."""
    uv: NDArray[np.float32] | None = None
    """(N, 2), v down from the upper edge of the image."""
    binding: Binding | None = None
    """Bones of the vertices; None: no bones deform them."""


def triangles_from_mesh(mesh: Mesh, binding: Binding | None = None) -> Triangles:
    """Return the triangles of a mesh, with a vertex for each distinct corner; `binding` is of the mesh's vertices."""
    faces = mesh.faces.astype(np.uint32)
    normals, uv = _unit_normals(mesh), _v_down(mesh)
    corners = [array for array in (normals, uv) if array is not None]
    if not corners:
        return Triangles(positions=mesh.vertices.astype(np.float32), indices=faces, binding=binding)
    rows = np.concatenate([faces.reshape(-1, 1), *(array.view(np.uint32) for array in corners)], axis=1)
    first, indices = _distinct_rows(rows)
    return Triangles(
        positions=mesh.vertices.astype(np.float32)[rows[first, 0]],
        binding=None
        if binding is None
        else Binding(bones=binding.bones[rows[first, 0]], weights=binding.weights[rows[first, 0]]),
        indices=indices.reshape(-1, 3),
        normals=None if normals is None else normals[first],
        uv=None if uv is None else uv[first],
    )


def _distinct_rows(rows: NDArray[np.uint32]) -> tuple[NDArray[np.intp], NDArray[np.uint32]]:
    """Return the index of each distinct row's first occurrence, in order, and each row's index among them.

    Rows are sorted by a hash, which takes a tenth of the time of sorting rows; in a collision no rows are merged.
    """
    hashed = np.zeros(len(rows), dtype=np.uint64)
    for column in range(rows.shape[1]):
        hashed = (hashed ^ rows[:, column]) * np.uint64(_MIX[column % 3])
        hashed ^= hashed >> np.uint64(29)
    _, first, inverse = np.unique(hashed, return_index=True, return_inverse=True)
    inverse = inverse.reshape(-1)
    if not np.array_equal(rows[first[inverse]], rows):
        identity = np.arange(len(rows))
        return identity, identity.astype(np.uint32)
    order = np.argsort(first)
    rank = np.empty(len(first), dtype=np.uint32)
    rank[order] = np.arange(len(first), dtype=np.uint32)
    return first[order], rank[inverse]


def _unit_normals(mesh: Mesh) -> NDArray[np.float32] | None:
    """Return (3 M, 3) unit normals of the corners; a face without normals has its face normal."""
    if mesh.normals is None:
        return None
    normals = mesh.normals.astype(np.float32)
    a, b, c = (mesh.vertices[mesh.faces[:, corner]] for corner in range(3))
    is_smooth = normals.any(axis=2, keepdims=True)
    normals = np.where(is_smooth, normals, np.cross(b - a, c - a)[:, None]).reshape(-1, 3)
    largest = np.abs(normals).max(axis=1, keepdims=True)
    normals = np.divide(normals, largest, out=np.broadcast_to(_UP, normals.shape).copy(), where=largest > 0.0)
    return np.ascontiguousarray(normals / np.linalg.norm(normals, axis=1, keepdims=True), dtype=np.float32)


def _v_down(mesh: Mesh) -> NDArray[np.float32] | None:
    if mesh.uv is None:
        return None
    uv = mesh.uv.reshape(-1, 2).astype(np.float32)
    uv[:, 1] = 1.0 - uv[:, 1]
    return uv
