from .actor_skins import (
    skinned_actors as skinned_actors,
    unsupported_reason as unsupported_reason,
    update_skins as update_skins,
)
from .bounds import corners_of as corners_of, outline_of as outline_of
from .from_world import scene_from_world as scene_from_world
from .named_textures import NAMED_TEXTURES as NAMED_TEXTURES, named_texture as named_texture
from .native import NativeRenderer as NativeRenderer
from .pixels import (
    add_color_noise as add_color_noise,
    add_depth_noise as add_depth_noise,
    clip_depths as clip_depths,
    colored_points as colored_points,
)
from .renderer import Intrinsics as Intrinsics, Picture as Picture, Renderer as Renderer, size_of as size_of
from .scene import (
    DEFAULT_LIGHTS as DEFAULT_LIGHTS,
    Scene as Scene,
    SceneLight as SceneLight,
    SceneSkin as SceneSkin,
    Shape as Shape,
    ShapeGeometry as ShapeGeometry,
)
from .textures import (
    LARGEST_TEXTURE_PX as LARGEST_TEXTURE_PX,
    load_texture as load_texture,
    report_unreadable_textures as report_unreadable_textures,
)
