"""Initialization: programs call it before they use a group."""

import atexit
import threading
from collections.abc import Sequence

import rospy

_lock = threading.Lock()
_name = "move_group_commander_wrappers"
_arguments: list[str] | None = None


def roscpp_init(name: str = _name, args: Sequence[str] = ()) -> None:
    """Remember the node's name and the remappings; the program's own rospy.init_node comes first."""
    global _name, _arguments
    _name, _arguments = name or _name, list(args)


def roscpp_shutdown() -> None:
    """Nothing to end: the node ends with the program."""


def ensure_node() -> None:
    """Make the program a node, unless it is one already."""
    with _lock:
        if not rospy.core.is_initialized():
            rospy.client.init_library_node(_name, _arguments)
            atexit.register(rospy.signal_shutdown, "atexit")
