from ._meshes import (
    SupportGraph as SupportGraph,
    component_labels as component_labels,
    double_areas as double_areas,
    fold_height as fold_height,
    unique_rows as unique_rows,
)
from .cache import cache_folder as cache_folder, load_parts as load_parts, save_parts as save_parts
from .heightmap_image import read_heights as read_heights
from .load import check_vertices as check_vertices, load_mesh as load_mesh
from .mesh import Mesh as Mesh, MeshError as MeshError, MeshPart as MeshPart, Texture as Texture
from .raw import RawPart as RawPart
from .references import referenced_files as referenced_files
from .road_strip import strip_mesh as strip_mesh
from .skeleton import Motion as Motion, Skin as Skin, match_bones as match_bones, root_of as root_of
from .skins import load_motion as load_motion, load_skin as load_skin
from .solid_meshes import cone_mesh as cone_mesh, prism_mesh as prism_mesh, terrain_mesh as terrain_mesh
from .texture import (
    decoding_error as decoding_error,
    ignored_decoder_warnings as ignored_decoder_warnings,
    image_file as image_file,
    mean_color as mean_color,
    png_of as png_of,
)
from .triangulation import triangulate as triangulate
