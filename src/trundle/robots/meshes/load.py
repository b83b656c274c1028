"""Loader of mesh files of any format, with a cache."""

import hashlib
import os
import re
from collections.abc import Generator, Sequence
from contextlib import contextmanager
from functools import lru_cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from trundle.base.files import read_file
from trundle.base.xmlnode import MAX_LENGTH

from . import cache
from .mesh import Mesh, MeshError, MeshPart, Rgba
from .raw import MAX_TRIANGLES, RawPart
from .texture import find_texture, mean_color

MAX_BYTES = 256 * 1024 * 1024
_SLOW = frozenset({".dae", ".glb", ".obj"})
"""Formats worth caching; STL is as fast as the cache."""
_FORMATS = _SLOW | {".stl"}
_MIN_CACHED_BYTES = 100_000
"""Minimum size of a cached file."""
_LIBRARY = re.compile(rb"^\s*mtllib\s+(.+?)\s*$", re.MULTILINE)


def load_mesh(path: Path, *, submesh: str | None = None, center: bool = False) -> Mesh:
    """Read a mesh file as one list of triangles, in parts of one color.

    Lengths are metres, except for .dae, which states its unit.

    Args:
        path: .dae, .stl, .obj or .glb.
        submesh: name of the parts to read; None: all.
        center: move the bounding box centre of the selected parts to the origin.

    Raises:
        MeshError: unreadable, too large, no triangles, or no such part.
    """
    with mesh_errors(path):
        suffix = path.suffix.lower()
        if suffix not in _FORMATS:
            formats = ", ".join(sorted(_FORMATS))
            raise MeshError(f"{suffix or 'files without ending'} meshes are not supported; formats: {formats}")
        stat = path.stat()
        return _load(path, suffix, submesh, center, (stat.st_mtime_ns, stat.st_size))


@contextmanager
def mesh_errors(path: Path) -> Generator[None]:
    """Convert every exception of a reader to a MeshError that starts with the file's name."""
    try:
        with np.errstate(all="ignore"):  # no warnings about damaged numbers, which are refused after reading
            yield
    except MeshError as error:
        raise MeshError(f"{path}: {error}") from None
    except OSError as error:
        raise MeshError(f"{path}: {error.strerror or error}") from None
    except Exception as error:  # every reader has its own exceptions
        message = " ".join(str(error).split()) or type(error).__name__
        raise MeshError(f"{path}: not readable as {path.suffix.lower()}: {message[:200]}") from None


@lru_cache(maxsize=256)
def _load(path: Path, suffix: str, submesh: str | None, center: bool, state: tuple[int, int]) -> Mesh:
    del state
    parts = _parts(path, suffix)
    if submesh is not None:
        chosen = [part for part in parts if submesh in part.names]
        if not chosen:
            names = sorted({part.names[0] for part in parts if part.names})
            raise MeshError(f"no part {submesh!r}; parts: {', '.join(map(repr, names)) or 'none'}")
        parts = chosen
    return joined(parts, path, center)


def _parts(path: Path, suffix: str) -> list[RawPart]:
    data = read_file(path, max_bytes=MAX_BYTES)
    if suffix not in _SLOW or len(data) < _MIN_CACHED_BYTES:
        return _read(data, suffix, path)
    key = hashlib.sha256(f"{cache.VERSION} {suffix} ".encode() + data)
    for name in _library_names(data) if suffix == ".obj" else []:
        key.update(_read_sibling(path, name) or b"")
    parts = cache.load_parts(key.hexdigest())
    if parts is None:
        parts = _read(data, suffix, path)
        cache.save_parts(key.hexdigest(), parts)
    return parts


def material_libraries(path: Path) -> list[Path]:
    """Return the material libraries that an .obj names, existing or not; none for other formats.

    Raises:
        OSError: the mesh cannot be read.
    """
    if path.suffix.lower() != ".obj":
        return []
    return [_sibling(path, name) for name in _library_names(read_file(path, max_bytes=MAX_BYTES))]


def _library_names(data: bytes) -> list[str]:
    return [name.decode("utf-8", "replace") for name in _LIBRARY.findall(data)]


def _read(data: bytes, suffix: str, path: Path) -> list[RawPart]:
    match suffix:
        case ".stl":
            from .stl import read_stl

            return read_stl(data)
        case ".obj":
            from .obj import read_obj

            return read_obj(data, lambda name: _read_sibling(path, name))
        case ".glb":
            from .glb import read_glb

            return read_glb(data)
        case _:
            from .collada.scene import read_collada

            return read_collada(data)


def _sibling(path: Path, name: str) -> Path:
    return path.parent / name.replace("\\", "/")


def _read_sibling(path: Path, name: str) -> bytes | None:
    """Read a file below the mesh's folder; None if it is missing, elsewhere or too large."""
    file = _sibling(path, name)
    try:
        inside = Path(os.path.realpath(file)).is_relative_to(os.path.realpath(path.parent))
        return read_file(file, max_bytes=MAX_BYTES) if inside else None
    except (OSError, ValueError):
        return None


def joined(parts: Sequence[RawPart], path: Path, center: bool) -> Mesh:
    """Join parts into one mesh, in order; parts without triangles are dropped.

    Raises:
        MeshError: no triangles, or an invalid triangle mesh.
    """
    parts = [part for part in parts if len(part.faces)]
    if not parts:
        raise MeshError("no triangles")
    if sum(len(part.faces) for part in parts) > MAX_TRIANGLES:
        raise MeshError(f"more than {MAX_TRIANGLES} triangles")
    vertices = np.concatenate([part.vertices for part in parts])
    first_vertex = np.cumsum([0, *(len(part.vertices) for part in parts)])
    faces = np.concatenate([part.faces + first for part, first in zip(parts, first_vertex, strict=False)])
    check_vertices(vertices)
    if faces.min() < 0 or faces.max() >= len(vertices):
        raise MeshError(f"a face names vertex {faces.max()} of {len(vertices)}")
    if center:
        vertices = vertices - (vertices.min(axis=0) + vertices.max(axis=0)) / 2
    described = _described(parts, path)
    return Mesh(
        vertices=np.ascontiguousarray(vertices, dtype=np.float32),
        faces=np.ascontiguousarray(faces, dtype=np.int32),
        rgba=max(described, key=lambda part: part.face_count).rgba,
        uv=_joined_corners([part.uv for part in parts], parts, 2),
        normals=_joined_corners([part.normals for part in parts], parts, 3),
        parts=described,
    )


def check_vertices(vertices: NDArray[np.floating]) -> None:
    """Refuse vertices (N, 3) that are not finite, or so far away that their products overflow.

    Raises:
        MeshError: a vertex is; the message has its index.
    """
    are_near = (np.abs(vertices) <= MAX_LENGTH).all(axis=1)  # False for NaN
    if not are_near.all():
        number = int(np.argmin(are_near))
        coordinates = " ".join(f"{value:g}" for value in vertices[number])
        raise MeshError(f"vertex {number} is at {coordinates}, which is not within ±{MAX_LENGTH:g}")


def _described(parts: Sequence[RawPart], path: Path) -> tuple[MeshPart, ...]:
    described: list[MeshPart] = []
    first_face = 0
    for part in parts:
        texture = find_texture(part.texture, path) if isinstance(part.texture, str) else part.texture
        mean = mean_color(texture) if texture else None
        rgba = part.rgba if mean is None else _tinted(mean, part.tint)
        name = part.names[0] if part.names else ""
        described.append(
            MeshPart(
                name=name,
                first_face=first_face,
                face_count=len(part.faces),
                rgba=rgba,
                texture=texture,
                tint=part.tint,
                missing_texture=part.texture if texture is None and isinstance(part.texture, str) else None,
            )
        )
        first_face += len(part.faces)
    return tuple(described)


def _tinted(rgba: Rgba, tint: Rgba) -> Rgba:
    r, g, b, a = (value * by for value, by in zip(rgba, tint, strict=True))
    return (r, g, b, a)


def _joined_corners(
    values: Sequence[NDArray[np.float32] | None], parts: Sequence[RawPart], size: int
) -> NDArray[np.float32] | None:
    """Return the corner values of all parts, with zeros for parts without any; None if no part has any."""
    if all(value is None for value in values):
        return None
    rows = [
        np.zeros((len(part.faces), 3, size), np.float32) if value is None else value
        for value, part in zip(values, parts, strict=True)
    ]
    return np.nan_to_num(np.concatenate(rows))
