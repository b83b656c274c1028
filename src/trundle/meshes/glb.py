"""Binary glTF, through trimesh; y is up by its standard, so it is turned to stand upright here."""

import io
import json
import logging
from typing import Any

import numpy as np

from .mesh import Rgba
from .raw import MOST_TRIANGLES, MeshError, RawPart
from .texture import mean_of

_JSON = b"JSON"

logging.getLogger("trimesh").addHandler(logging.NullHandler())  # else it prints a traceback for a missing texture


def read_glb(data: bytes) -> list[RawPart]:
    """Read a GLB without following any reference out of it; of a texture inside, only the mean colour is kept.

    Raises:
        Exception: trimesh's own, in its own words.
    """
    import trimesh

    _check_counts(data)
    scene: Any = trimesh.load_scene(io.BytesIO(data), file_type="glb", process=False, skip_materials=False)
    parts: list[RawPart] = []
    triangles = 0
    for node in scene.graph.nodes_geometry:
        transform, name = scene.graph[node]
        geometry = scene.geometry[name]
        if not hasattr(geometry, "faces"):
            continue
        vertices = np.asarray(geometry.vertices, dtype=np.float64) @ transform[:3, :3].T + transform[:3, 3]
        faces = np.asarray(geometry.faces, dtype=np.int64)
        triangles += len(faces)
        if triangles > MOST_TRIANGLES:
            raise MeshError(f"more than {MOST_TRIANGLES} triangles")
        parts.append(
            RawPart(
                names=(str(name), str(node)),
                vertices=vertices[:, [0, 2, 1]] * (1.0, -1.0, 1.0),
                faces=faces[:, ::-1] if np.linalg.det(transform[:3, :3]) < 0 else faces,
                rgba=_colour(geometry),
            )
        )
    return parts


def _check_counts(data: bytes) -> None:
    """Refuse accessors that promise more than the file holds: memory is taken for them before they are read."""
    length = int.from_bytes(data[12:16], "little")
    if data[:4] != b"glTF" or data[16:20] != _JSON or len(data) < 20 + length:
        raise MeshError("no binary glTF, or cut short")
    tree = json.loads(data[20 : 20 + length])
    counts = [accessor.get("count", 0) for accessor in tree.get("accessors", [])]
    if any(not isinstance(count, int) or not 0 <= count <= len(data) for count in counts):
        raise MeshError("promises more vertices than it has bytes")
    if any("uri" in buffer for buffer in tree.get("buffers", [])):
        raise MeshError("its vertices are in another file, which is not read")


def _colour(geometry: Any) -> Rgba | None:
    material = getattr(geometry.visual, "material", None)
    if material is None:
        return None
    r, g, b, a = (float(value) / 255.0 for value in material.main_color)
    image = getattr(material, "baseColorTexture", None)
    if image is None:
        return (r, g, b, a)
    if material.baseColorFactor is None:
        r = g = b = a = 1.0
    mean = mean_of(image)
    return (r * mean[0], g * mean[1], b * mean[2], a)
