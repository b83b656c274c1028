"""Membership of objects in the state of a simulation."""

import sys
from types import BuiltinFunctionType, ModuleType, SimpleNamespace

from msgspec import Struct

from trundle.base.diagnostics import Diagnostic, Diagnostics, Source
from trundle.sim.physics import Contacts
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
"""Rooms of Trundle whose objects are contents of files, belong to devices, or have checkpoints."""
_OUTSIDE_OF_PUBLIC = (Diagnostics, Struct, Diagnostic, Source, Contacts)
"""Classes of `trundle` itself, whose structs are immutable."""
_CONTAINERS = ("builtins", "collections", "functools", "random", "types")
_LIBRARIES = ("mujoco", "lxml", "msgspec", "rosbags", "PIL", "aiohttp")


def is_outside(obj: object) -> bool:
    """True if no step of the simulation changes the object, or no restore could undo the change: modules, devices,
    threads, objects of the standard library other than containers.
    """
    kind = type(obj)
    if isinstance(obj, Simulation):
        return False
    if isinstance(obj, ModuleType | BuiltinFunctionType):
        return True
    room, _, rest = kind.__module__.partition(".")
    if room == "trundle":
        return f"{rest}.".startswith(_OUTSIDE) if rest else isinstance(obj, _OUTSIDE_OF_PUBLIC)
    if room in _CONTAINERS or kind is SimpleNamespace or _is_container_subclass(kind):
        return False
    return room in _LIBRARIES or room in sys.stdlib_module_names


def _is_container_subclass(kind: type) -> bool:
    """True for a subclass of a container, defined outside Trundle."""
    return issubclass(kind, dict | list | set)
