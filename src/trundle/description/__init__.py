"""Text becomes model: SDF, URDF and xacro, each by its own rules."""

from .load import load, load_urdf
from .loaded import Loaded
from .xacro import expand_xacro

__all__ = ["Loaded", "expand_xacro", "load", "load_urdf"]
