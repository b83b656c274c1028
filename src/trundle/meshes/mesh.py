"""Triangles, in parts that each have a colour."""

from functools import lru_cache
from pathlib import Path
from typing import TypeAlias

import numpy as np
from msgspec import Struct
from msgspec.structs import replace
from numpy.typing import NDArray

from trundle.diagnostics import TrundleError

Rgba: TypeAlias = tuple[float, float, float, float]
Texture: TypeAlias = Path | bytes
"""An image: its file, or what a file of it would hold where it is inside the mesh's own."""


class MeshError(TrundleError):
    """A mesh file that cannot be used; the text says why."""


class MeshPart(Struct, frozen=True, kw_only=True):
    """Some faces of a mesh in a row: what a file gives one material."""

    name: str
    """Of the node or object it comes from."""
    first_face: int
    face_count: int
    rgba: Rgba | None = None
    """The file's own colour; where there is a texture, its mean. None: the file has none."""
    texture: Texture | None = None
    """An image, laid out by the mesh's `uv`."""
    tint: Rgba = (1.0, 1.0, 1.0, 1.0)
    """What the image's colours are multiplied by."""
    missing_texture: str | None = None
    """What the file names and is not there."""


class Mesh(Struct, frozen=True, eq=False):
    """A triangle mesh in its own frame, in metres, z up."""

    vertices: NDArray[np.float32]
    """(N, 3) [m]"""
    faces: NDArray[np.int32]
    """(M, 3) indices into the vertices, counter-clockwise from outside."""
    rgba: Rgba | None = None
    """The colour of its largest part; None where that has none."""
    uv: NDArray[np.float32] | None = None
    """(M, 3, 2) where each corner of each face is in an image: u to the right, v up, (0, 0) at the lower left of the
    image, beyond 0…1 it repeats. Zeros in parts whose file has none; None: no part has any. Where only the description
    paints a mesh, its texture is laid out by this too."""
    parts: tuple[MeshPart, ...] = ()
    """In the order of the faces; none: all of one colour."""
    normals: NDArray[np.float32] | None = None
    """(M, 3, 3) which way the surface faces at each corner of each face, of any length, for light that runs smoothly
    over edges; zeros, or None, where faces are flat."""

    def degenerate_face_count(self) -> int:
        """How many faces have corners on one line, or one place."""
        a, b, c = (self.vertices[self.faces[:, corner]] for corner in range(3))
        with np.errstate(over="ignore", invalid="ignore"):
            return int((~np.cross(b - a, c - a).any(axis=1)).sum())

    def scaled(self, scale: tuple[float, float, float]) -> "Mesh":
        """The mesh stretched along its axes; a mirrored one keeps its outside outside."""
        if scale == (1.0, 1.0, 1.0):
            return self
        mirrored = scale[0] * scale[1] * scale[2] < 0
        step = -1 if mirrored else 1
        factors = np.asarray(scale, dtype=np.float32)
        upright = factors[[1, 2, 0]] * factors[[2, 0, 1]] * np.float32(step)  # along 1 / factors, where none is 0 too
        return replace(
            self,
            vertices=self.vertices * factors,
            faces=self.faces[:, ::step].copy(),
            uv=None if self.uv is None else self.uv[:, ::step].copy(),
            normals=None if self.normals is None else self.normals[:, ::step] * upright,
        )

    def with_vertices(self, vertices: NDArray[np.float32]) -> "Mesh":
        """The mesh with its vertices elsewhere, (N, 3) [m]; its normals turn as their faces do."""
        if self.normals is None:
            return replace(self, vertices=vertices)
        in_face = self.normals @ _axes(self.vertices[self.faces]).transpose(0, 2, 1)
        normals = (in_face @ _axes(vertices[self.faces])).astype(np.float32)
        return replace(self, vertices=vertices, normals=normals)

    def split_by_material(self) -> tuple["Mesh", ...]:
        """The mesh cut into meshes of one colour and one texture each, which its first part has."""
        return _split_by_material(self)


def _axes(corners: NDArray[np.float32]) -> NDArray[np.float32]:
    """Of triangles (M, 3, 3): three axes in rows that turn with them, (M, 3, 3); zeros where there is no area."""
    along = corners[:, 1] - corners[:, 0]
    up = np.cross(along, corners[:, 2] - corners[:, 0])
    axes = np.stack([along, np.cross(up, along), up], axis=1)
    return axes / np.maximum(np.linalg.norm(axes, axis=2, keepdims=True), np.float32(1e-30))


@lru_cache(maxsize=256)  # a robot's four wheels are to stay instances of one mesh
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
