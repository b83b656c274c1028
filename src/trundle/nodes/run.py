"""Runs a stand-in as its node."""

from trundle.ros import NOETIC, PROFILES, Node, follow_time

from .find import Replacement
from .host import Host


async def run_stand_in(replacement: Replacement, node: Node, arguments: list[str], host: Host) -> int:
    """Run a stand-in until it ends or is cancelled, and shut its node down; return the exit code.

    Args:
        replacement: from `find_node`.
        node: made for the launch's node, with its remappings.
        arguments: the command line without the program and without remappings.
        host: what the program offers.
    """
    try:
        await node.ready()  # its `_name:=value` parameters are set
        await follow_time(node)
        distro = str(await node.get_param("/rosdistro", "")).strip()
        node.profile = PROFILES.get(distro, NOETIC)
        return await replacement.load()(node, arguments, host).run()
    finally:
        await node.shutdown()
