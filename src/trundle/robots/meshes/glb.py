"""Reader of binary glTF through trimesh; glTF's y-up is converted to z-up."""

import io
import json
import logging
from typing import Any

import numpy as np
from msgspec.structs import replace

from .mesh import MeshError
from .raw import MAX_TRIANGLES, RawPart, at_corners
from .texture import as_png

_JSON = b"JSON"

logging.getLogger("trimesh").addHandler(logging.NullHandler())  # else trimesh prints tracebacks for missing textures


def read_glb(data: bytes) -> list[RawPart]:
    """Read a GLB without following external references.

    Raises:
        Exception: any exception of trimesh.
    """
    import trimesh

    _check_counts(data)
    scene: Any = trimesh.load_scene(io.BytesIO(data), file_type="glb", process=False, skip_materials=False)
    parts: list[RawPart] = []
    pictures: dict[int, bytes | None] = {}
    triangles = 0
    for node in scene.graph.nodes_geometry:
        transform, name = scene.graph[node]
        geometry = scene.geometry[name]
        if not hasattr(geometry, "faces"):
            continue
        vertices = np.asarray(geometry.vertices, dtype=np.float64) @ transform[:3, :3].T + transform[:3, 3]
        faces = np.asarray(geometry.faces, dtype=np.int64)
        triangles += len(faces)
        if triangles > MAX_TRIANGLES:
            raise MeshError(f"more than {MAX_TRIANGLES} triangles")
        faces = faces[:, ::-1] if np.linalg.det(transform[:3, :3]) < 0 else faces
        normals = None
        if "vertex_normals" in geometry._cache:  # without normals, glTF prescribes flat faces
            turned = np.asarray(geometry.vertex_normals, dtype=np.float64) @ np.linalg.pinv(transform[:3, :3])
            normals = at_corners(turned[:, [0, 2, 1]] * (1.0, -1.0, 1.0), faces, 3)
        part = RawPart(
            names=(str(name), str(node)),
            vertices=vertices[:, [0, 2, 1]] * (1.0, -1.0, 1.0),
            faces=faces,
            normals=normals,
        )
        parts.append(_painted(part, geometry.visual, pictures))
    return parts


def _check_counts(data: bytes) -> None:
    """Refuse accessors that declare more than the file contains, as trimesh allocates their memory first."""
    length = int.from_bytes(data[12:16], "little")
    if data[:4] != b"glTF" or data[16:20] != _JSON or len(data) < 20 + length:
        raise MeshError("not a binary glTF, or truncated")
    tree = json.loads(data[20 : 20 + length])
    counts = [accessor.get("count", 0) for accessor in tree.get("accessors", [])]
    if any(not isinstance(count, int) or not 0 <= count <= len(data) for count in counts):
        raise MeshError("declares more vertices than it has bytes")
    if any("uri" in buffer for buffer in tree.get("buffers", [])):
        raise MeshError("its vertices are in another file, which is not read")


def _painted(part: RawPart, visual: Any, pictures: dict[int, bytes | None]) -> RawPart:
    """Return a part with its material; trimesh has already flipped glTF's v, which points down."""
    uv = getattr(visual, "uv", None)
    if uv is not None:
        part = replace(part, uv=at_corners(np.asarray(uv, dtype=np.float64), part.faces, 2))
    material = getattr(visual, "material", None)
    if material is None:
        return part
    r, g, b, a = (float(value) / 255.0 for value in material.main_color)
    image = getattr(material, "baseColorTexture", None)
    if image is None or part.uv is None:
        return replace(part, rgba=(r, g, b, a))
    if id(image) not in pictures:
        pictures[id(image)] = as_png(image)
    if pictures[id(image)] is None:
        return replace(part, rgba=(r, g, b, a), texture=f"image inside, of material {material.name!r}")
    tint = (1.0, 1.0, 1.0, 1.0) if material.baseColorFactor is None else (r, g, b, a)
    return replace(part, texture=pictures[id(image)], tint=tint)
