"""Which objects belong to the state of a simulation."""

import sys
from types import BuiltinFunctionType, ModuleType, SimpleNamespace

from trundle.sim.simulation import Simulation

_OUTSIDE = (
    *("app.", "live.", "page."),
    *("base.console.", "base.diagnostics.", "base.signals.", "base.xmlnode."),
    *("gazebo.check.", "gazebo.missing_nodes.", "gazebo.model_plugins.", "gazebo.plugin_error."),
    *("robots.description.", "robots.launch.", "robots.lint.", "robots.load_input.", "robots.meshes."),
    *("robots.model.", "robots.packages."),
    *("ros._message_codec.", "ros.bags.", "ros.clients.", "ros.core.", "ros.distro.", "ros.errors.", "ros.log."),
    *("ros.log_file.", "ros.master.", "ros.message_types.", "ros.messages.", "ros.migration.", "ros.node."),
    *("ros.transport.", "ros.xmlrpc."),
    *("sim.gltf.", "sim.physics.", "sim.realtime_pacer.", "sim.render.", "sim.renderers.", "sim.timeline."),
)
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
        return f"{rest}.".startswith(_OUTSIDE)
    if room in _CONTAINERS or kind is SimpleNamespace or _has_own_attributes(kind):
        return False
    return room in _LIBRARIES or room in sys.stdlib_module_names


def _has_own_attributes(kind: type) -> bool:
    """True of a subclass of a container from elsewhere."""
    return issubclass(kind, dict | list | set)
