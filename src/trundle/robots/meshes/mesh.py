"""Triangle meshes, in parts of one color."""

from functools import lru_cache
from pathlib import Path
from typing import TypeAlias

import numpy as np
from msgspec import Struct
from msgspec.structs import replace
from numpy.typing import NDArray

from trundle.base.diagnostics import TrundleError

Rgba: TypeAlias = tuple[float, float, float, float]
Texture: TypeAlias = Path | bytes
"""Image file, or its content if embedded in the mesh file."""


class MeshError(TrundleError):
    """Unusable mesh file, with the reason."""

    __module__ = "trundle"

    id = "mesh"


class MeshPart(Struct, frozen=True, kw_only=True):
    """Contiguous faces of a mesh with one material."""

    name: str
    """Name of the node or object in the file."""
    first_face: int
    face_count: int
    rgba: Rgba | None = None
    """Color in the file, or the texture's mean color; None: the file has none."""
    texture: Texture | None = None
    """Texture, mapped by the mesh's `uv`."""
    tint: Rgba = (1.0, 1.0, 1.0, 1.0)
    """Factor of the texture's colors."""
    missing_texture: str | None = None
    """Texture named in the file that was not found."""


class Mesh(Struct, frozen=True, eq=False):
    """Triangle mesh in its own frame, in metres, z up."""

    vertices: NDArray[np.float32]
    """(N, 3) [m]"""
    faces: NDArray[np.int32]
    """(M, 3) vertex indices, counter-clockwise from outside."""
    rgba: Rgba | None = None
    """Color of the largest part; None if it has none."""
    uv: NDArray[np.float32] | None = None
    """(M, 3, 2) texture coordinates of each face corner: u to the right, v up, (0, 0) at the lower left of the image,
    repeated beyond 0…1. Zeros for parts without any; None: no part has any. They also map a texture set by the
    description alone.
    """
    parts: tuple[MeshPart, ...] = ()
    """Parts in the order of the faces; empty: one color."""
    normals: NDArray[np.float32] | None = None
    """(M, 3, 3) normals of each face corner, of any length, for smooth shading; zeros, or None, for flat faces."""

    def degenerate_face_count(self) -> int:
        """Return the number of faces with collinear or coincident corners."""
        a, b, c = (self.vertices[self.faces[:, corner]] for corner in range(3))
        with np.errstate(over="ignore", invalid="ignore"):
            return int((~np.cross(b - a, c - a).any(axis=1)).sum())

    def scaled(self, scale: tuple[float, float, float]) -> "Mesh":
        """Return the mesh scaled along its axes; a mirrored one keeps its faces outwards."""
        return self if scale == (1.0, 1.0, 1.0) else _scaled(self, scale)

    def with_vertices(self, vertices: NDArray[np.float32]) -> "Mesh":
        """Return the mesh with other vertices (N, 3) [m]; its normals rotate with their faces."""
        if self.normals is None:
            return replace(self, vertices=vertices)
        in_face = self.normals @ _axes(self.vertices[self.faces]).transpose(0, 2, 1)
        normals = (in_face @ _axes(vertices[self.faces])).astype(np.float32)
        return replace(self, vertices=vertices, normals=normals)

    def split_by_material(self) -> tuple["Mesh", ...]:
        """Return the mesh split into meshes of one color and one texture, stored in their first part."""
        return _split_by_material(self)


def _axes(corners: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return (M, 3, 3) axes, in rows, that rotate with triangles (M, 3, 3); zeros for those without area."""
    along = corners[:, 1] - corners[:, 0]
    up = np.cross(along, corners[:, 2] - corners[:, 0])
    axes = np.stack([along, np.cross(up, along), up], axis=1)
    return axes / np.maximum(np.linalg.norm(axes, axis=2, keepdims=True), np.float32(1e-30))


@lru_cache(maxsize=256)  # the original, so that a robot's four wheels stay instances of one mesh
def _scaled(mesh: Mesh, scale: tuple[float, float, float]) -> Mesh:
    mirrored = scale[0] * scale[1] * scale[2] < 0
    step = -1 if mirrored else 1
    factors = np.asarray(scale, dtype=np.float32)
    upright = factors[[1, 2, 0]] * factors[[2, 0, 1]] * np.float32(step)  # parallel to 1 / factors, finite for zeros
    return replace(
        mesh,
        vertices=mesh.vertices * factors,
        faces=mesh.faces[:, ::step].copy(),
        uv=None if mesh.uv is None else mesh.uv[:, ::step].copy(),
        normals=None if mesh.normals is None else mesh.normals[:, ::step] * upright,
    )


@lru_cache(maxsize=256)
def _split_by_material(mesh: Mesh) -> tuple[Mesh, ...]:
    looks: dict[tuple[Rgba | None, Texture | None, Rgba], list[MeshPart]] = {}
    for part in mesh.parts:
        looks.setdefault((part.rgba, part.texture, part.tint), []).append(part)
    return tuple(_submesh(mesh, parts) for parts in looks.values()) if len(looks) > 1 else (mesh,)


def _submesh(mesh: Mesh, parts: list[MeshPart]) -> Mesh:
    rows = np.concatenate([np.arange(part.first_face, part.first_face + part.face_count) for part in parts])
    faces = mesh.faces[rows]
    used, renumbered = np.unique(faces, return_inverse=True)
    return Mesh(
        vertices=mesh.vertices[used],
        faces=renumbered.reshape(faces.shape).astype(np.int32),
        rgba=parts[0].rgba,
        uv=None if mesh.uv is None else mesh.uv[rows],
        normals=None if mesh.normals is None else mesh.normals[rows],
        parts=(replace(parts[0], first_face=0, face_count=len(faces)),),
    )
