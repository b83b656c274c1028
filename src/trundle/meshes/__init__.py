"""Vertex arrays from .dae, .stl, .obj and .glb files, from images and from outlines."""

from .cache import keep, load_kept
from .heights import read_heights
from .load import load_mesh
from .load_skin import load_motion, load_skin
from .mesh import Mesh, MeshPart, Texture
from .polygons import triangles_of
from .raw import MeshError, RawPart
from .skeleton import Motion, Skin, matched, root_of
from .solids import cone_mesh, prism_mesh, terrain_mesh
from .strip import strip_mesh
from .texture import mean_colour, png_of

__all__ = [
    "Mesh",
    "MeshError",
    "MeshPart",
    "Motion",
    "RawPart",
    "Skin",
    "Texture",
    "cone_mesh",
    "keep",
    "load_kept",
    "load_mesh",
    "load_motion",
    "load_skin",
    "matched",
    "mean_colour",
    "png_of",
    "prism_mesh",
    "read_heights",
    "root_of",
    "strip_mesh",
    "terrain_mesh",
    "triangles_of",
]
