"""What there is to see, as plain data, and what a renderer makes of it."""

from typing import TYPE_CHECKING

from trundle.doors import opened_on_use

if TYPE_CHECKING:
    from .extent import corners_of, outline_of
    from .from_world import scene_of
    from .native import NativeRenderer
    from .pixels import add_colour_noise, add_depth_noise, clip_depths, coloured_points
    from .renderer import Intrinsics, Picture, Renderer, size_of
    from .scene import Scene, SceneLight, SceneSkin, Shape, ShapeGeometry
    from .skins import move_skins, why_stiff

_HOMES = {
    "coloured_points": "pixels",
    "add_depth_noise": "pixels",
    "add_colour_noise": "pixels",
    "clip_depths": "pixels",
    "Intrinsics": "renderer",
    "NativeRenderer": "native",
    "Picture": "renderer",
    "Renderer": "renderer",
    "Scene": "scene",
    "SceneLight": "scene",
    "SceneSkin": "scene",
    "Shape": "scene",
    "ShapeGeometry": "scene",
    "corners_of": "extent",
    "move_skins": "skins",
    "outline_of": "extent",
    "scene_of": "from_world",
    "size_of": "renderer",
    "why_stiff": "skins",
}
__getattr__ = opened_on_use(__name__, _HOMES)

__all__ = [
    "Intrinsics",
    "NativeRenderer",
    "Picture",
    "Renderer",
    "Scene",
    "SceneLight",
    "SceneSkin",
    "Shape",
    "ShapeGeometry",
    "add_colour_noise",
    "add_depth_noise",
    "clip_depths",
    "coloured_points",
    "corners_of",
    "move_skins",
    "outline_of",
    "scene_of",
    "size_of",
    "why_stiff",
]
