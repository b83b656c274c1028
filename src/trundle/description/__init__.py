"""Text becomes model, and model text: SDF, URDF and xacro, each by its own rules."""

from .load import load, load_text, load_urdf
from .loaded import Loaded
from .sdf import GAZEBO_MATERIALS, read_extra_joint
from .writing import UriOf, write_sdf, write_urdf, written_uri
from .xacro import expand_xacro

__all__ = [
    "GAZEBO_MATERIALS",
    "Loaded",
    "UriOf",
    "expand_xacro",
    "load",
    "load_text",
    "load_urdf",
    "read_extra_joint",
    "write_sdf",
    "write_urdf",
    "written_uri",
]
