"""Vertex arrays from .dae, .stl, .obj and .glb files."""

from .mesh import Mesh

__all__ = ["Mesh"]
