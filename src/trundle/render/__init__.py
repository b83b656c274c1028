"""What there is to see, as plain data, and the pictures and ranges made from it."""

from .scene import Scene, SceneLight, Shape, ShapeGeometry

__all__ = ["Scene", "SceneLight", "Shape", "ShapeGeometry"]
