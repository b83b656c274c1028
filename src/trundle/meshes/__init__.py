"""Vertex arrays from .dae, .stl, .obj and .glb files."""

from .load import load_mesh
from .mesh import Mesh, MeshPart, Texture
from .raw import MeshError

__all__ = ["Mesh", "MeshError", "MeshPart", "Texture", "load_mesh"]
