"""Old base library: `load_manifest`, and locations of packages."""

from importlib import import_module
from types import ModuleType

from .launcher import load_manifest as load_manifest

_is_interactive = False
_SUBMODULES = frozenset({"exceptions", "message", "msgs", "names", "network", "packages", "rosenv", "scriptutil"})


def __getattr__(name: str) -> ModuleType:
    """Import a submodule; in ROS rospy and rostopic import them, so programs use them without an import."""
    if name in _SUBMODULES:
        return import_module(f"roslib.{name}")
    raise AttributeError(f"module 'roslib' has no attribute '{name}'")


def set_interactive(interactive: bool) -> None:
    """Declare that this is an interactive shell, whose signals rospy leaves alone."""
    global _is_interactive
    _is_interactive = interactive


def is_interactive() -> bool:
    """True in an interactive shell."""
    return _is_interactive
