"""Vertex arrays from .dae, .stl, .obj and .glb files."""

from .load import MeshError, load_mesh
from .mesh import Mesh

__all__ = ["Mesh", "MeshError", "load_mesh"]
