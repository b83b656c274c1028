"""Vertex arrays from .dae, .stl, .obj and .glb files, from images and from outlines."""

from typing import TYPE_CHECKING

from trundle.doors import opened_on_use

if TYPE_CHECKING:
    from .cache import keep, load_kept
    from .heights import read_heights
    from .load import load_mesh
    from .mesh import Mesh, MeshError, MeshPart, Texture
    from .polygons import triangles_of
    from .raw import RawPart
    from .skeleton import Motion, Skin, matched, root_of
    from .skins import load_motion, load_skin
    from .solids import cone_mesh, prism_mesh, terrain_mesh
    from .strip import strip_mesh
    from .texture import image_file, mean_colour, png_of, why_undecoded

_HOMES = {
    "Mesh": "mesh",
    "MeshError": "mesh",
    "MeshPart": "mesh",
    "Motion": "skeleton",
    "RawPart": "raw",
    "Skin": "skeleton",
    "Texture": "mesh",
    "cone_mesh": "solids",
    "image_file": "texture",
    "keep": "cache",
    "load_kept": "cache",
    "load_mesh": "load",
    "load_motion": "skins",
    "load_skin": "skins",
    "matched": "skeleton",
    "mean_colour": "texture",
    "png_of": "texture",
    "prism_mesh": "solids",
    "read_heights": "heights",
    "root_of": "skeleton",
    "strip_mesh": "strip",
    "terrain_mesh": "solids",
    "triangles_of": "polygons",
    "why_undecoded": "texture",
}
__getattr__ = opened_on_use(__name__, _HOMES)

__all__ = [
    "Mesh",
    "MeshError",
    "MeshPart",
    "Motion",
    "RawPart",
    "Skin",
    "Texture",
    "cone_mesh",
    "image_file",
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
    "why_undecoded",
]
