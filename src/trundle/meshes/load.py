"""Reads mesh files through trimesh and pycollada."""

import logging
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from trundle.diagnostics import TrundleError

from .mesh import Mesh

_MOST_BYTES = 256 * 1024 * 1024
_FORMATS = frozenset({".dae", ".stl", ".obj", ".glb"})
_Y_UP = frozenset({".glb"})
"""glTF is y up by its standard. The others are taken as z up, .dae too whatever its <up_axis> says: Gazebo
(gazebo-classic#1305) and RViz (rviz#1045) never read that tag, and published robots are made to look right in them."""

logging.getLogger("trimesh").addHandler(logging.NullHandler())  # else it prints a traceback for a missing texture


class MeshError(TrundleError):
    """A mesh file that cannot be used; the text says why."""


@lru_cache(maxsize=256)
def load_mesh(path: Path, *, submesh: str | None = None, center: bool = False) -> Mesh:
    """Read a mesh file into one list of triangles.

    The numbers of a file are metres, but for .dae, which states its own unit.

    Args:
        path: .dae, .stl, .obj or .glb.
        submesh: only the part of this name.
        center: move the middle of that part's bounding box to the origin.

    Raises:
        MeshError: unreadable, too large, no triangles, or no such part.
    """
    import trimesh

    suffix = path.suffix.lower()
    if suffix not in _FORMATS:
        raise MeshError(
            f"{path}: {suffix or 'files without ending'} meshes are not read; {', '.join(sorted(_FORMATS))} are"
        )
    try:
        if path.stat().st_size > _MOST_BYTES:
            raise MeshError(f"{path}: larger than {_MOST_BYTES >> 20} MiB")
        scene = trimesh.load_scene(str(path), process=False)
        parts = _parts(scene, submesh, path)
    except MeshError:
        raise
    except Exception as error:  # every reader behind trimesh fails in its own way
        raise MeshError(f"{path}: not readable as {suffix}: {error}") from None
    vertices = np.concatenate([v for v, _, _ in parts])
    offsets = np.cumsum([0, *(len(v) for v, _, _ in parts[:-1])])
    faces = np.concatenate([f + offset for (_, f, _), offset in zip(parts, offsets, strict=True)])
    if len(faces) == 0 or not np.isfinite(vertices).all():
        raise MeshError(f"{path}: no triangles, or vertices that are not finite")
    if suffix == ".dae":
        vertices = vertices * _metres_per_unit(scene)
    if suffix in _Y_UP:
        vertices = vertices[:, [0, 2, 1]] * (1.0, -1.0, 1.0)
    if center:
        vertices = vertices - (vertices.min(axis=0) + vertices.max(axis=0)) / 2
    colours = [colour for _, _, colour in parts if colour is not None]
    return Mesh(
        vertices=np.ascontiguousarray(vertices, dtype=np.float32),
        faces=np.ascontiguousarray(faces, dtype=np.int32),
        rgba=colours[0] if colours else None,
    )


_Part = tuple[NDArray[np.float64], NDArray[np.int64], "tuple[float, float, float, float] | None"]


def _parts(scene: Any, submesh: str | None, path: Path) -> list[_Part]:
    """The triangles of a scene, node by node, moved to where the scene has them."""
    parts: list[_Part] = []
    names: list[str] = []
    for node in scene.graph.nodes_geometry:
        transform, geometry_name = scene.graph[node]
        geometry = scene.geometry[geometry_name]
        names.append(str(geometry_name))
        if submesh is not None and submesh not in (geometry_name, node):
            continue
        if not hasattr(geometry, "faces"):
            continue
        vertices = geometry.vertices @ transform[:3, :3].T + transform[:3, 3]
        parts.append((np.asarray(vertices), np.asarray(geometry.faces), _colour(geometry)))
    if submesh is not None and not parts:
        raise MeshError(f"{path}: no part {submesh!r}; parts there: {', '.join(map(repr, names)) or 'none'}")
    if not parts:
        raise MeshError(f"{path}: no triangles")
    return parts


def _metres_per_unit(scene: Any) -> float:
    """COLLADA's <unit meter="…">, which trimesh hands on as the text `0.01 * meters`."""
    number, _, unit = str(scene.units or "").rpartition("*")
    return float(number) if number and unit.strip() == "meters" else 1.0


def _colour(geometry: Any) -> tuple[float, float, float, float] | None:
    material = getattr(geometry.visual, "material", None)
    if material is None:
        return None
    r, g, b, a = (float(c) / 255.0 for c in material.main_color)
    return (r, g, b, a)
