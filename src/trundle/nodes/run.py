"""Runs a stand-in as its node."""

import asyncio

from trundle.ros import DISTROS, NOETIC, Node, follow_time

from .find import BuiltinReplacement
from .host import NodeHost


async def run_builtin_node(replacement: BuiltinReplacement, node: Node, arguments: list[str], host: NodeHost) -> int:
    """Run a stand-in until it ends, is cancelled or its node is killed, and shut that down; return the exit code.

    Args:
        replacement: from `find_node`.
        node: made for the launch's node, with its remappings.
        arguments: the command line without the program and without remappings.
        host: what the program offers.
    """
    killed = asyncio.Event()
    node.on_shutdown(lambda _: killed.set())
    try:
        await node.wait_registered()  # its `_name:=value` parameters are set
        await follow_time(node)
        distro = str(await node.params.get("/rosdistro", "")).strip()
        node.profile = DISTROS.get(distro, NOETIC)
        running = asyncio.create_task(replacement.load()(node, arguments, host).run())
        waiting = asyncio.create_task(killed.wait())
        try:
            await asyncio.wait((running, waiting), return_when=asyncio.FIRST_COMPLETED)
            return running.result() if running.done() else 0
        finally:
            running.cancel()
            waiting.cancel()
            await asyncio.wait((running,))
    finally:
        await node.shutdown()
