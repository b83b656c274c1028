"""Triangles, in parts that each have a colour."""

from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

Rgba: TypeAlias = tuple[float, float, float, float]
Texture: TypeAlias = Path | bytes
"""An image: its file, or what a file of it would hold where it is inside the mesh's own."""


@dataclass(frozen=True, slots=True, kw_only=True)
class MeshPart:
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
    lost_texture: str | None = None
    """What the file names and is not there."""


@dataclass(frozen=True, slots=True, eq=False)
class Mesh:
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

    def scaled(self, scale: tuple[float, float, float]) -> "Mesh":
        """The mesh stretched along its axes; a mirrored one keeps its outside outside."""
        if scale == (1.0, 1.0, 1.0):
            return self
        mirrored = scale[0] * scale[1] * scale[2] < 0
        faces = self.faces[:, ::-1].copy() if mirrored else self.faces
        uv = self.uv[:, ::-1].copy() if mirrored and self.uv is not None else self.uv
        return Mesh(self.vertices * np.asarray(scale, dtype=np.float32), faces, self.rgba, uv, self.parts)

    def by_look(self) -> tuple["Mesh", ...]:
        """The mesh cut into meshes of one colour and one texture each, which its first part has."""
        return _by_look(self)


@lru_cache(maxsize=256)  # a robot's four wheels are to stay instances of one mesh
def _by_look(mesh: Mesh) -> tuple[Mesh, ...]:
    looks: dict[tuple[Rgba | None, Texture | None, Rgba], list[MeshPart]] = {}
    for part in mesh.parts:
        looks.setdefault((part.rgba, part.texture, part.tint), []).append(part)
    return tuple(_cut_out(mesh, parts) for parts in looks.values()) if len(looks) > 1 else (mesh,)


def _cut_out(mesh: Mesh, parts: list[MeshPart]) -> Mesh:
    rows = np.concatenate([np.arange(part.first_face, part.first_face + part.face_count) for part in parts])
    faces = mesh.faces[rows]
    used, renumbered = np.unique(faces, return_inverse=True)
    return Mesh(
        vertices=mesh.vertices[used],
        faces=renumbered.reshape(faces.shape).astype(np.int32),
        rgba=parts[0].rgba,
        uv=None if mesh.uv is None else mesh.uv[rows],
        parts=(replace(parts[0], first_face=0, face_count=len(faces)),),
    )
