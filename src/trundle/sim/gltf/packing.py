"""Bytes of triangles, described by glTF's accessors."""

import hashlib
from functools import lru_cache
from typing import Any

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from trundle.robots.meshes import Mesh

from .triangles import Triangles, triangles_from_mesh

FLOAT, _USHORT, _UINT = 5126, 5123, 5125
_ARRAY, _ELEMENTS = 34962, 34963
_TYPES = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4"}
_MAX_USHORT = 65535
"""Restarts a strip; the largest index of two bytes is smaller."""


class PackedArray(Struct, frozen=True, kw_only=True):
    """Array within the bytes."""

    attribute: str
    """POSITION, NORMAL, TEXCOORD_0, JOINTS_0 or WEIGHTS_0; empty: the indices."""
    offset: int
    size: int
    """[bytes]"""
    target: int
    """Buffer target of OpenGL."""
    accessor: dict[str, object]
    """Type, count and bounds."""


class PackedTriangles(Struct, frozen=True, eq=False, kw_only=True):
    """Bytes of triangles: indices, positions, normals, texture coordinates, bones and their weights."""

    name: str
    """Hash of the bytes."""
    data: bytes
    arrays: tuple[PackedArray, ...]

    @property
    def has_uv(self) -> bool:
        """True if there are texture coordinates."""
        return any(array.attribute == "TEXCOORD_0" for array in self.arrays)


@lru_cache(maxsize=256)
def packed_mesh(mesh: Mesh) -> PackedTriangles:
    """Return the bytes of a mesh."""
    return pack(triangles_from_mesh(mesh))


def pack(triangles: Triangles) -> PackedTriangles:
    """Return the bytes of triangles, each array from a multiple of four."""
    index = np.uint16 if len(triangles.positions) <= _MAX_USHORT else np.uint32
    binding = triangles.binding
    arrays: dict[str, NDArray[Any] | None] = {
        "": triangles.indices.reshape(-1, 1).astype(index),
        "POSITION": triangles.positions,
        "NORMAL": triangles.normals,
        "TEXCOORD_0": triangles.uv,
        "JOINTS_0": None if binding is None else binding.bones,
        "WEIGHTS_0": None if binding is None else binding.weights,
    }
    data = bytearray()
    packed: list[PackedArray] = []
    for attribute, array in arrays.items():
        if array is None:
            continue
        packed.append(
            PackedArray(
                attribute=attribute,
                offset=len(data),
                size=array.nbytes,
                target=_ARRAY if attribute else _ELEMENTS,
                accessor=_accessor(array, bounded=attribute == "POSITION"),
            )
        )
        little = np.ascontiguousarray(array, dtype=array.dtype.newbyteorder("<"))
        data += little.tobytes() + bytes(-little.nbytes % 4)
    return PackedTriangles(name=content_name(data), data=bytes(data), arrays=tuple(packed))


def content_name(data: bytes | bytearray) -> str:
    """Return a name for bytes, unique to their content."""
    return hashlib.blake2b(data, digest_size=16).hexdigest()


def _accessor(array: NDArray[Any], *, bounded: bool) -> dict[str, object]:
    accessor: dict[str, object] = {
        "componentType": {"f": FLOAT, "H": _USHORT, "I": _UINT}[array.dtype.char],
        "count": len(array),
        "type": _TYPES[array.shape[1]],
    }
    if bounded:
        accessor |= {"min": array.min(axis=0).tolist(), "max": array.max(axis=0).tolist()}
    return accessor
