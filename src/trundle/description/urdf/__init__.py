"""URDF lowered to SDF's meaning, as Gazebo does it."""

from .lower import lower_robot

__all__ = ["lower_robot"]
