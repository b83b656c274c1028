"""URDF lowered to SDF's meaning, as Gazebo does it."""

from .lower import lower_robot
from .text import read_urdf_text

__all__ = ["lower_robot", "read_urdf_text"]
