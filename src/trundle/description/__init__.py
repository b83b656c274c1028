"""Text becomes model, and model text: SDF, URDF and xacro, each by its own rules."""

from typing import TYPE_CHECKING

from trundle.doors import opened_on_use

if TYPE_CHECKING:
    from .loaded import Loaded
    from .read import load, load_text, load_urdf
    from .sdf import GAZEBO_MATERIALS, read_extra_joint
    from .writing import UriOf, write_sdf, write_urdf, written_uri
    from .xacro import expand_xacro

_HOMES = {
    "GAZEBO_MATERIALS": "sdf",
    "Loaded": "loaded",
    "UriOf": "writing",
    "expand_xacro": "xacro",
    "load": "read",
    "load_text": "read",
    "load_urdf": "read",
    "read_extra_joint": "sdf",
    "write_sdf": "writing",
    "write_urdf": "writing",
    "written_uri": "writing",
}
__getattr__ = opened_on_use(__name__, _HOMES)

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
