"""Names of all targets; their modules are imported on use."""

import importlib

from .target import Target

_FAMILIES = {
    "descriptions": ("sdf", "urdf", "xacro", "model.config", "package.xml", "material", "scene"),
    "arms": ("arm-urdf", "srdf", "joint-limits", "moveit-config"),
    "launches": ("launch", "yaml", "map", "pgm"),
    "messages": ("msg", "srv", "action", "definition", "cfg", "message"),
    "meshes": ("stl", "obj", "dae", "glb", "skin", "bvh"),
    "images": ("png", "jpeg", "tiff", "dem"),
    "recordings": ("bag", "rosrecord", "mcap", "state-log"),
    "plans": ("sweep", "dataset"),
    "rviz": ("rviz",),
    "graph": ("xmlrpc", "slave", "tcpros", "tcpros-client", "service-client"),
    "navigation": ("navigation",),
    "web": ("foxglove", "http", "upload", "zip", "rosbridge", "rosbridge-tcp"),
}
TARGETS = {name: family for family, names in _FAMILIES.items() for name in names}
"""Target → module."""
NATIVE = frozenset(
    {
        "scene", "msg", "srv", "action", "definition", "message", "stl", "obj", "dae", "glb", "bag", "rosrecord",
        "mcap", "tcpros", "tcpros-client", "service-client", "foxglove", "rosbridge", "rosbridge-tcp",
        "navigation", "arm-urdf", "srdf", "joint-limits", "moveit-config",
    }
)  # fmt: skip
"""Targets that run C++ code, with sanitizers."""


def load_target(name: str) -> Target:
    """Import a target."""
    return importlib.import_module(f".{TARGETS[name]}", __package__).TARGETS[name]
