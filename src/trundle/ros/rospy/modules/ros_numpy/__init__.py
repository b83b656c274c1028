"""Conversion of messages to numpy arrays and back."""

from . import geometry, image, occupancy_grid, point_cloud2
from .numpy_msg import numpy_msg
from .registry import msgify, numpify

__all__ = ["geometry", "image", "msgify", "numpify", "numpy_msg", "occupancy_grid", "point_cloud2"]
