"""Result of the format readers: parts in the file's own units, in double precision."""

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from .mesh import Rgba

MAX_TRIANGLES = 20_000_000
"""Maximum number of triangles of a mesh; a small file can instantiate a part repeatedly."""


class RawSkin(Struct, frozen=True, eq=False, kw_only=True):
    """Bone weights of a part's vertices."""

    bound: NDArray[np.float64]
    """(N, 3) vertices in the bind pose."""
    bones: tuple[str, ...]
    bone_from_skin: NDArray[np.float64]
    """(bones, 4, 4) inverse bind matrices."""
    influences: NDArray[np.intp]
    """(N, K) indices into the bones."""
    weights: NDArray[np.float64]
    """(N, K) weights; each row's sum is 1."""


class RawPart(Struct, frozen=True, kw_only=True):
    """Triangles of one material in one node or object."""

    names: tuple[str, ...]
    """Names for <submesh>, the usual one first."""
    vertices: NDArray[np.float64]
    """(N, 3)"""
    faces: NDArray[np.int64]
    """(M, 3)"""
    rgba: Rgba | None = None
    texture: str | bytes | None = None
    """Path relative to the mesh file, as written, or the embedded image."""
    tint: Rgba = (1.0, 1.0, 1.0, 1.0)
    """Factor of the texture's colors."""
    uv: NDArray[np.float32] | None = None
    """(M, 3, 2) texture coordinates of each face corner; v is up."""
    normals: NDArray[np.float32] | None = None
    """(M, 3, 3) normals of each face corner, of any length."""
    skin: RawSkin | None = None
    """None: not bound to bones."""


def used_vertices(
    vertices: NDArray[np.float64], faces: NDArray[np.int64]
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Return the vertices used by faces, and the faces with new indices.

    Raises:
        IndexError: a face refers to a missing vertex.
    """
    if len(faces) and (faces.max() >= len(vertices) or faces.min() < 0):
        raise IndexError(f"a face names vertex {faces.max()} of {len(vertices)}")
    used, renumbered = np.unique(faces, return_inverse=True)
    return vertices[used], renumbered.reshape(faces.shape)


def at_corners(values: NDArray[np.float64], faces: NDArray[np.int64], size: int) -> NDArray[np.float32] | None:
    """Return the first `size` components of a value per face corner, (M, 3, size), by faces that index the values.

    None if an index is out of range.
    """
    if not len(faces) or faces.min() < 0 or faces.max() >= len(values) or values.shape[1] < size:
        return None
    return values[faces][..., :size].astype(np.float32)


def triangle_fans(indices: NDArray[np.int64], counts: NDArray[np.int64]) -> NDArray[np.int64]:
    """Triangulate consecutive polygons as fans: (M, 3) positions in `indices`.

    Raises:
        ValueError: the counts do not add up.
    """
    if counts.sum() != len(indices) or (len(counts) and counts.min() < 0):
        raise ValueError("polygons with more corners than there are")
    triangles = np.maximum(counts - 2, 0)
    starts = np.repeat(np.cumsum(counts) - counts, triangles)
    turn = np.arange(len(starts)) - np.repeat(np.cumsum(triangles) - triangles, triangles)
    return np.stack([starts, starts + turn + 1, starts + turn + 2], axis=1)
