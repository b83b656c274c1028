"""Wavefront OBJ and its materials."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from .mesh import Rgba
from .raw import RawPart, fans, unrolled

ReadBeside = Callable[[str], bytes | None]
"""A file beside the mesh, by its relative path; None where there is none."""


@dataclass(slots=True)
class _Group:
    """Faces of one object and one material."""

    corners: list[int] = field(default_factory=list[int])
    uv_corners: list[int] = field(default_factory=list[int])
    counts: list[int] = field(default_factory=list[int])


@dataclass(frozen=True, slots=True)
class _Look:
    rgba: Rgba
    texture: str | None = None


def read_obj(data: bytes, beside: ReadBeside) -> list[RawPart]:
    """Read an OBJ; lines and points are no triangles and are passed over.

    Raises:
        ValueError, IndexError: numbers that are none.
    """
    vertices: list[list[float]] = []
    places: list[list[float]] = []
    looks: dict[str, _Look] = {}
    groups: dict[tuple[str, str], _Group] = {}
    name, material = "", ""
    for line in data.replace(b"\\\r\n", b" ").replace(b"\\\n", b" ").decode("utf-8", "replace").splitlines():
        words = line.split()
        match words[:1]:
            case ["v"]:
                vertices.append([float(word) for word in words[1:4]])
            case ["vt"]:
                places.append([float(word) for word in (*words[1:3], "0")[:2]])
            case ["f"]:
                _add_face(groups.setdefault((name, material), _Group()), words[1:], len(vertices), len(places))
            case ["o" | "g"]:
                name = " ".join(words[1:])
            case ["usemtl"]:
                material = " ".join(words[1:])
            case ["mtllib"]:
                looks |= read_mtl(beside(line.split(maxsplit=1)[1].strip()) or b"")
            case _:
                pass
    points = np.array(vertices, dtype=np.float64).reshape(-1, 3)
    uv = np.array(places, dtype=np.float64).reshape(-1, 2)
    return [_part(group, points, uv, key[0], looks.get(key[1])) for key, group in groups.items()]


def _add_face(group: _Group, corners: list[str], vertices: int, places: int) -> None:
    """Indices count from 1, or from the latest back if negative."""
    for corner in corners:
        index, _, rest = corner.partition("/")
        place = rest.partition("/")[0]
        group.corners.append(_index(index, vertices))
        group.uv_corners.append(_index(place, places) if place else -1)
    group.counts.append(len(corners))


def _index(text: str, count: int) -> int:
    number = int(text)
    index = number - 1 if number > 0 else count + number
    if not 0 <= index < count:
        raise IndexError(f"a face names number {number} of {count}")
    return index


def _part(group: _Group, points: np.ndarray, uv: np.ndarray, name: str, look: _Look | None) -> RawPart:
    corners = np.array(group.corners, dtype=np.int64)
    uv_corners = np.array(group.uv_corners, dtype=np.int64)
    triangles = fans(corners, np.array(group.counts, dtype=np.int64))
    textured = look is not None and look.texture is not None and len(uv_corners) and uv_corners.min() >= 0
    vertices, faces, own_uv = unrolled(
        points, corners[triangles], uv if textured else None, uv_corners[triangles] if textured else None
    )
    return RawPart(
        names=(name,),
        vertices=vertices,
        faces=faces,
        rgba=look.rgba if look else None,
        texture=look.texture if look and textured else None,
        uv=own_uv,
    )


def read_mtl(data: bytes) -> dict[str, _Look]:
    """The materials of a library: diffuse colour, opacity and diffuse map."""
    looks: dict[str, _Look] = {}
    name = ""
    for line in data.decode("utf-8", "replace").splitlines():
        words = line.split()
        if len(words) < 2:
            continue
        keyword = words[0].lower()
        if keyword == "newmtl":
            name = " ".join(words[1:])
            looks[name] = _Look((0.8, 0.8, 0.8, 1.0))
        look = looks.get(name)
        if look is None:
            continue
        r, g, b, a = look.rgba
        if keyword == "kd" and len(words) >= 4:
            r, g, b = (_fraction(word) for word in words[1:4])
        elif keyword == "d":
            a = _fraction(words[-1])
        elif keyword == "tr":
            a = 1.0 - _fraction(words[-1])
        texture = words[-1] if keyword == "map_kd" else look.texture  # options such as -s 1 1 1 come before the name
        looks[name] = _Look((r, g, b, a), texture)
    return looks


def _fraction(word: str) -> float:
    try:
        value = float(word)
    except ValueError:
        return 1.0
    return min(max(value, 0.0), 1.0) if value == value else 1.0
