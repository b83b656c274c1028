"""What the readers of the formats give: loose parts in the file's own units, in double precision."""

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from .mesh import Rgba

MAX_TRIANGLES = 20_000_000
"""More than any robot; a file can ask for more by naming one part over and over."""


class RawSkin(Struct, frozen=True, eq=False, kw_only=True):
    """How a part's vertices hang on bones."""

    bound: NDArray[np.float64]
    """(N, 3) the vertices where they were bound."""
    bones: tuple[str, ...]
    bone_from_skin: NDArray[np.float64]
    """(bones, 4, 4)"""
    influences: NDArray[np.intp]
    """(N, K) indices into the bones."""
    weights: NDArray[np.float64]
    """(N, K) of each; each row's sum is 1."""


class RawPart(Struct, frozen=True, kw_only=True):
    """The triangles of one material in one node or object."""

    names: tuple[str, ...]
    """What a description may call it by, the usual one first."""
    vertices: NDArray[np.float64]
    """(N, 3)"""
    faces: NDArray[np.int64]
    """(M, 3)"""
    rgba: Rgba | None = None
    texture: str | bytes | None = None
    """A path relative to the mesh file, as written, or the image itself."""
    tint: Rgba = (1.0, 1.0, 1.0, 1.0)
    """What the texture's colours are multiplied by."""
    uv: NDArray[np.float32] | None = None
    """(M, 3, 2) of each corner of each face; v is up."""
    normals: NDArray[np.float32] | None = None
    """(M, 3, 3) of each corner of each face, of any length."""
    skin: RawSkin | None = None
    """None: it hangs on no bones."""


def used_vertices(
    vertices: NDArray[np.float64], faces: NDArray[np.int64]
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """The vertices that faces name, and the faces numbered anew.

    Raises:
        IndexError: a face names a vertex that is not there.
    """
    if len(faces) and (faces.max() >= len(vertices) or faces.min() < 0):
        raise IndexError(f"a face names vertex {faces.max()} of {len(vertices)}")
    used, renumbered = np.unique(faces, return_inverse=True)
    return vertices[used], renumbered.reshape(faces.shape)


def at_corners(values: NDArray[np.float64], faces: NDArray[np.int64], size: int) -> NDArray[np.float32] | None:
    """The first numbers of a value for each corner: (M, 3, size), by faces that number values.

    None where they name one that is not there.
    """
    if not len(faces) or faces.min() < 0 or faces.max() >= len(values) or values.shape[1] < size:
        return None
    return values[faces][..., :size].astype(np.float32)


def triangle_fans(indices: NDArray[np.int64], counts: NDArray[np.int64]) -> NDArray[np.int64]:
    """The corners of polygons, one after another, as fans of triangles: (M, 3) positions in `indices`.

    Raises:
        ValueError: the counts do not add up.
    """
    if counts.sum() != len(indices) or (len(counts) and counts.min() < 0):
        raise ValueError("polygons with more corners than there are")
    triangles = np.maximum(counts - 2, 0)
    starts = np.repeat(np.cumsum(counts) - counts, triangles)
    turn = np.arange(len(starts)) - np.repeat(np.cumsum(triangles) - triangles, triangles)
    return np.stack([starts, starts + turn + 1, starts + turn + 2], axis=1)
