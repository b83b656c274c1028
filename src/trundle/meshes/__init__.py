"""Vertex arrays from .dae, .stl, .obj and .glb files, from images and from outlines."""

from .heights import read_heights
from .load import load_mesh
from .mesh import Mesh, MeshPart, Texture
from .polygons import triangles_of
from .raw import MeshError
from .solids import cone_mesh, prism_mesh, terrain_mesh
from .strip import strip_mesh
from .texture import mean_colour

__all__ = [
    "Mesh",
    "MeshError",
    "MeshPart",
    "Texture",
    "cone_mesh",
    "load_mesh",
    "mean_colour",
    "prism_mesh",
    "read_heights",
    "strip_mesh",
    "terrain_mesh",
    "triangles_of",
]
