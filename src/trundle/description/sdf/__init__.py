"""SDF 1.0 to 1.12, each file read by the rules of its own version."""

from .context import DEEPEST, Context
from .extra_joint import read_extra_joint
from .gazebo_materials import GAZEBO_MATERIALS
from .old_style import rewrite_old_style
from .version import read_version
from .world import read_root

__all__ = [
    "DEEPEST",
    "GAZEBO_MATERIALS",
    "Context",
    "read_extra_joint",
    "read_root",
    "read_version",
    "rewrite_old_style",
]
