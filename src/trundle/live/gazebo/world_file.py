"""World files that gzserver is asked to open."""

import os

from trundle.robots.packages import Packages
from trundle.ros import Node

_EMPTY_WORLD = "worlds/empty.world"


def find_world(world: str, packages: Packages, node: Node) -> str:
    """Find the world asked for; without such a file, log an error and return gzserver's empty one."""
    is_there = world.startswith(("model://", "file://")) or os.path.exists(os.path.expanduser(world))
    if is_there or packages.find_world(world) is not None:
        return world
    known = ", ".join(packages.worlds())
    node.log.error(
        f"{world}: no such world file; {_EMPTY_WORLD} is opened in its place, as gzserver does; worlds that come "
        f"with Trundle: {known}; others are searched along GAZEBO_RESOURCE_PATH"
    )
    return _EMPTY_WORLD
