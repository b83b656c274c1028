"""Vertex arrays from .dae, .stl, .obj and .glb files, from images and from outlines."""

from .cache import keep, load_kept
from .heights import read_heights
from .load import load_mesh
from .mesh import Mesh, MeshPart, Texture
from .polygons import triangles_of
from .raw import MeshError, RawPart
from .solids import cone_mesh, prism_mesh, terrain_mesh
from .strip import strip_mesh
from .texture import mean_colour

__all__ = [
    "Mesh",
    "MeshError",
    "MeshPart",
    "RawPart",
    "Texture",
    "cone_mesh",
    "keep",
    "load_kept",
    "load_mesh",
    "mean_colour",
    "prism_mesh",
    "read_heights",
    "strip_mesh",
    "terrain_mesh",
    "triangles_of",
]
