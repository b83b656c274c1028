"""Reader of Wavefront OBJ and its materials."""

from collections.abc import Callable

import numpy as np
from msgspec import Struct, field

from .mesh import Rgba
from .raw import RawPart, at_corners, triangle_fans, used_vertices

ReadSibling = Callable[[str], bytes | None]
"""Reads a file by its path relative to the mesh; None if it is missing."""


class _Group(Struct):
    """Faces of one object and one material."""

    corners: list[int] = field(default_factory=list[int])
    uv_corners: list[int] = field(default_factory=list[int])
    normal_corners: list[int] = field(default_factory=list[int])
    counts: list[int] = field(default_factory=list[int])


class _Material(Struct):
    """Material of a library."""

    diffuse: tuple[float, float, float] | None = None
    opacity: float = 1.0
    texture: str | None = None

    def over(self, r: float, g: float, b: float) -> Rgba:
        """Return the material's color, or a default."""
        return (*(self.diffuse or (r, g, b)), self.opacity)


def read_obj(data: bytes, read_sibling: ReadSibling) -> list[RawPart]:
    """Read an OBJ; lines and points are skipped.

    Raises:
        ValueError, IndexError: invalid numbers.
    """
    vertices: list[list[float]] = []
    uvs: list[list[float]] = []
    normals: list[list[float]] = []
    materials: dict[str, _Material] = {}
    groups: dict[tuple[str, str], _Group] = {}
    name, material = "", ""
    for line in data.replace(b"\\\r\n", b" ").replace(b"\\\n", b" ").decode("utf-8", "replace").splitlines():
        words = line.split()
        match words[:1]:
            case ["v"]:
                vertices.append([float(word) for word in words[1:4]])
            case ["vt"]:
                uvs.append([float(word) for word in (*words[1:3], "0")[:2]])
            case ["vn"]:
                normals.append([float(word) for word in words[1:4]])
            case ["f"]:
                counts = (len(vertices), len(uvs), len(normals))
                _add_face(groups.setdefault((name, material), _Group()), words[1:], counts)
            case ["o" | "g"]:
                name = " ".join(words[1:])
            case ["usemtl"]:
                material = " ".join(words[1:])
            case ["mtllib"]:
                materials |= read_mtl(read_sibling(line.split(maxsplit=1)[1].strip()) or b"")
            case _:
                pass
    points = np.array(vertices, dtype=np.float64).reshape(-1, 3)
    uv = np.array(uvs, dtype=np.float64).reshape(-1, 2)
    directions = np.array(normals, dtype=np.float64).reshape(-1, 3)
    return [_part(group, points, uv, directions, key[0], materials.get(key[1])) for key, group in groups.items()]


def _add_face(group: _Group, corners: list[str], counts: tuple[int, int, int]) -> None:
    """Add a face; its indices count from 1, or backwards from the last if negative.

    `counts` are the numbers of vertices, texture coordinates and normals so far.
    """
    for corner in corners:
        index, uv, normal = (*corner.split("/"), "", "")[:3]
        group.corners.append(_index(index, counts[0]))
        group.uv_corners.append(_index(uv, counts[1]) if uv else -1)
        group.normal_corners.append(_index(normal, counts[2]) if normal else -1)
    group.counts.append(len(corners))


def _index(text: str, count: int) -> int:
    number = int(text)
    index = number - 1 if number > 0 else count + number
    if not 0 <= index < count:
        raise IndexError(f"a face names number {number} of {count}")
    return index


def _part(
    group: _Group, points: np.ndarray, uv: np.ndarray, normals: np.ndarray, name: str, look: _Material | None
) -> RawPart:
    corners = np.array(group.corners, dtype=np.int64)
    uv_corners = np.array(group.uv_corners, dtype=np.int64)
    triangles = triangle_fans(corners, np.array(group.counts, dtype=np.int64))
    vertices, faces = used_vertices(points, corners[triangles])
    corner_uv = at_corners(uv, uv_corners[triangles], 2)
    return RawPart(
        names=(name,),
        vertices=vertices,
        faces=faces,
        rgba=None if look is None else look.over(0.8, 0.8, 0.8),
        texture=None if look is None or corner_uv is None else look.texture,
        tint=(1.0, 1.0, 1.0, 1.0) if look is None else look.over(1.0, 1.0, 1.0),
        uv=corner_uv,
        normals=at_corners(normals, np.array(group.normal_corners, dtype=np.int64)[triangles], 3),
    )


def read_mtl(data: bytes) -> dict[str, _Material]:
    """Return the materials of a library: diffuse color, opacity and diffuse map."""
    looks: dict[str, _Material] = {}
    look = _Material()
    for line in data.decode("utf-8", "replace").splitlines():
        words = line.split()
        if len(words) < 2:
            continue
        keyword = words[0].lower()
        if keyword == "newmtl":
            look = looks.setdefault(" ".join(words[1:]), _Material())
        elif keyword == "kd" and len(words) >= 4:
            r, g, b = (_fraction(word) for word in words[1:4])
            look.diffuse = (r, g, b)
        elif keyword == "d":
            look.opacity = _fraction(words[-1])
        elif keyword == "tr":
            look.opacity = 1.0 - _fraction(words[-1])
        elif keyword == "map_kd":
            look.texture = words[-1]  # the name comes after options such as -s 1 1 1
    return looks


def _fraction(word: str) -> float:
    try:
        value = float(word)
    except ValueError:
        return 1.0
    return min(max(value, 0.0), 1.0) if value == value else 1.0
