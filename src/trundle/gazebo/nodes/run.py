"""Runs a built-in node."""

import asyncio

from trundle.ros import DISTROS, NOETIC, Node, follow_time

from .find import BuiltinReplacement
from .host import NodeHost


async def run_builtin_node(replacement: BuiltinReplacement, node: Node, arguments: list[str], host: NodeHost) -> int:
    """Run a built-in node until it ends, is cancelled or killed, and shut it down; returns the exit code.

    Args:
        replacement: result of `find_node`.
        node: node with the name and remappings of the launch.
        arguments: command line without program and remappings.
        host: services of this program.
    """
    killed = asyncio.Event()
    node.on_shutdown(lambda _: killed.set())
    try:
        await node.wait_registered()  # sets the parameters `_name:=value`
        await follow_time(node)
        distro = str(await node.params.get("/rosdistro", "")).strip()
        node.profile = DISTROS.get(distro, NOETIC)
        run_task = asyncio.create_task(replacement.load()(node, arguments, host).run())
        kill_task = asyncio.create_task(killed.wait())
        try:
            await asyncio.wait((run_task, kill_task), return_when=asyncio.FIRST_COMPLETED)
            return run_task.result() if run_task.done() else 0
        finally:
            run_task.cancel()
            kill_task.cancel()
            await asyncio.wait((run_task,))
    finally:
        await node.shutdown()
