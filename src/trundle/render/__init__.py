"""What there is to see, as plain data, and what a renderer makes of it."""

from .extent import corners_of, outline_of
from .from_world import scene_of
from .native import NativeRenderer
from .renderer import Intrinsics, Picture, Renderer, size_of
from .scene import Scene, SceneLight, SceneSkin, Shape, ShapeGeometry
from .skins import move_skins, why_stiff

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
    "corners_of",
    "move_skins",
    "outline_of",
    "scene_of",
    "size_of",
    "why_stiff",
]
