"""ROS command-line tools started as nodes by launch files: rostopic pub, rosbag record, …"""

import asyncio
import contextlib
import os
import signal
import subprocess
import sys

from trundle.ros import Node

from .host import NodeHost

_TIMEOUT_S = 5.0
"""Timeout after SIGINT, for a bag to be closed."""


class CommandLineTool:
    """Runs `trundle COMMAND…` in a process, and returns its exit code."""

    command: tuple[str, ...]
    takes_remappings = True

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        self._env = host.env
        self._tree = host.tree
        self._node = node
        self._arguments = arguments

    async def run(self) -> int:
        """Run until the tool exits."""
        node = self._node
        environment = {
            **os.environ,
            **self._env,
            "ROS_MASTER_URI": node.master_uri,
            "ROS_NAMESPACE": node.name.rpartition("/")[0],
        }
        name_and_remappings: list[str] = []
        if self.takes_remappings:
            await node.shutdown()  # the tool registers under this name itself
            name_and_remappings = [
                f"__name:={node.name.rpartition('/')[2]}",
                *(f"{a}:={b}" for a, b in node.remappings.items()),
            ]
        self._tree.watch()
        process = await asyncio.create_subprocess_exec(
            *(sys.executable, "-m", "trundle", *self.command, *self._arguments, *name_and_remappings),
            env=self._tree.environment(environment),
            stdin=subprocess.DEVNULL,
            start_new_session=os.name == "posix",
        )
        self._tree.add(process.pid)
        try:
            return await process.wait()
        finally:
            await _end(process)
            self._tree.discard(process.pid)


async def _end(process: asyncio.subprocess.Process) -> None:
    """Send SIGINT, and kill after a timeout."""
    if process.returncode is not None:
        return
    with contextlib.suppress(ProcessLookupError):
        process.send_signal(signal.SIGINT if os.name == "posix" else signal.SIGTERM)
    try:
        await asyncio.wait_for(process.wait(), _TIMEOUT_S)
    except TimeoutError:
        with contextlib.suppress(ProcessLookupError):
            process.kill()
        await process.wait()


class Rostopic(CommandLineTool):
    """rostopic/rostopic"""

    command = ("topic",)


class Rosservice(CommandLineTool):
    """rosservice/rosservice"""

    command = ("service",)


class Rosparam(CommandLineTool):
    """rosparam/rosparam"""

    command = ("param",)
    takes_remappings = False


class RosbagRecord(CommandLineTool):
    """rosbag/record"""

    command = ("bag", "record")


class RosbagPlay(CommandLineTool):
    """rosbag/play"""

    command = ("bag", "play")


class TfEcho(CommandLineTool):
    """tf/tf_echo, tf2_tools/echo.py"""

    command = ("tf", "echo")


class TfMonitor(CommandLineTool):
    """tf/tf_monitor"""

    command = ("tf", "monitor")


class ViewFrames(CommandLineTool):
    """tf/view_frames, tf2_tools/view_frames.py: writes the tree to frames.svg in the working directory"""

    command = ("tf", "tree", "-o", "frames.svg")
