"""What there is to see, as plain data, and what a renderer makes of it."""

from .extent import corners_of
from .from_world import scene_of
from .native import NativeRenderer
from .renderer import Intrinsics, Picture, Renderer
from .scene import Scene, SceneLight, Shape, ShapeGeometry

__all__ = [
    "Intrinsics",
    "NativeRenderer",
    "Picture",
    "Renderer",
    "Scene",
    "SceneLight",
    "Shape",
    "ShapeGeometry",
    "corners_of",
    "scene_of",
]
