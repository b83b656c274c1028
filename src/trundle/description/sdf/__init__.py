"""SDF 1.0 to 1.12, each file read by the rules of its own version."""

from typing import TYPE_CHECKING

from trundle.doors import opened_on_use

if TYPE_CHECKING:
    from .context import DEEPEST, Context
    from .extra_joint import read_extra_joint
    from .gazebo_materials import GAZEBO_MATERIALS
    from .old_style import rewrite_old_style
    from .required import name_missing_attributes
    from .version import read_version
    from .world import read_root

_HOMES = {
    "DEEPEST": "context",
    "GAZEBO_MATERIALS": "gazebo_materials",
    "Context": "context",
    "name_missing_attributes": "required",
    "read_extra_joint": "extra_joint",
    "read_root": "world",
    "read_version": "version",
    "rewrite_old_style": "old_style",
}
__getattr__ = opened_on_use(__name__, _HOMES)

__all__ = [
    "DEEPEST",
    "GAZEBO_MATERIALS",
    "Context",
    "name_missing_attributes",
    "read_extra_joint",
    "read_root",
    "read_version",
    "rewrite_old_style",
]
