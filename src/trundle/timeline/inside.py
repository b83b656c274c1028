"""Which objects belong to the state of a simulation."""

import sys
from types import BuiltinFunctionType, ModuleType, SimpleNamespace

from trundle.simulation import Simulation

_OUTSIDE = {
    *("bringup", "cli", "description", "diagnostics", "gltf", "launch", "lint", "meshes", "model"),
    *("packages", "page", "physics", "render", "ros", "timeline", "xmlnode"),
}
"""Trundle's rooms whose objects are files as read, devices, or have checkpoints of their own."""
_CONTAINERS = ("builtins", "collections", "functools", "random", "types")
_LIBRARIES = ("mujoco", "lxml", "msgspec", "rosbags", "PIL", "aiohttp")


def is_outside(each: object) -> bool:
    """True of what no step of the simulation changes, or no restore could: modules, devices, threads, the standard
    library's objects but its containers.
    """
    kind = type(each)
    if isinstance(each, Simulation):
        return False
    if isinstance(each, ModuleType | BuiltinFunctionType):
        return True
    room, _, rest = kind.__module__.partition(".")
    if room == "trundle":
        return rest.partition(".")[0] in _OUTSIDE
    if room in _CONTAINERS or kind is SimpleNamespace or _has_own_attributes(kind):
        return False
    return room in _LIBRARIES or room in sys.stdlib_module_names


def _has_own_attributes(kind: type) -> bool:
    """True of a subclass of a container from elsewhere."""
    return issubclass(kind, dict | list | set)
