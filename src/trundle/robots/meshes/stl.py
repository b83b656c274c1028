"""Reader of STL: triangles in metres, binary or ASCII."""

import re

import numpy as np

from ._meshes import unique_rows
from .mesh import MeshError
from .raw import RawPart

_HEADER = 84
_TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
_VERTEX = re.compile(rb"vertex\s+(\S+)\s+(\S+)\s+(\S+)", re.IGNORECASE)


def read_stl(data: bytes) -> list[RawPart]:
    """Read binary or ASCII STL; many binary files start with `solid`, so the size decides.

    Raises:
        MeshError: no STL.
    """
    may_be_text = data[:_HEADER].lstrip().lower().startswith(b"solid")
    count = int.from_bytes(data[80:_HEADER], "little") if len(data) >= _HEADER else 0
    whole = _HEADER + count * _TRIANGLE.itemsize
    if count and (len(data) == whole or (len(data) > whole and not may_be_text)):
        corners = np.frombuffer(data, dtype=_TRIANGLE, count=count, offset=_HEADER)["corners"].reshape(-1, 3)
    elif may_be_text and _VERTEX.search(data):
        numbers = np.array(_VERTEX.findall(data), dtype="S")
        corners = numbers[: len(numbers) // 3 * 3].astype(np.float64)
    elif count:
        available = max(len(data) - _HEADER, 0) // _TRIANGLE.itemsize
        raise MeshError(f"declares {count} triangles and contains {available}")
    else:
        raise MeshError("no triangles")
    first, number = unique_rows(np.ascontiguousarray(corners))
    return [RawPart(names=("",), vertices=corners[first].astype(np.float64), faces=number.reshape(-1, 3))]
