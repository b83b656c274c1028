"""Mesh files as shape_msgs/Mesh."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from geometry_msgs.msg import Point
from shape_msgs.msg import Mesh, MeshTriangle

from trundle.robots.meshes import MeshError, load_mesh

from .exception import MoveItCommanderException


def read_mesh(filename: str, scale: Sequence[float]) -> Any:
    """Return the triangles of a file (.stl, .dae, .obj, .glb), scaled along the axes [m]."""
    path = Path(filename.removeprefix("file://")).expanduser()
    try:
        found = load_mesh(path)
    except MeshError as error:
        raise MoveItCommanderException(str(error)) from error
    mesh: Any = Mesh()
    mesh.triangles = [MeshTriangle(vertex_indices=list(face)) for face in found.faces.tolist()]
    sx, sy, sz = map(float, scale)
    mesh.vertices = [Point(x * sx, y * sy, z * sz) for x, y, z in found.vertices.tolist()]
    return mesh
