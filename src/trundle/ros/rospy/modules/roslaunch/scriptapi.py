"""Launching of nodes from a program."""

import shlex
import time

import rosgraph

from .core import Node, Process, RLException
from .parent import ROSLaunchParent


class ROSLaunch:
    """Nodes and launch files, run by `trundle`."""

    def __init__(self) -> None:
        self.started = False
        self.parent: ROSLaunchParent | None = None
        self._core: Process | None = None
        self._processes: list[Process] = []

    def load(self, f: str) -> None:
        """Set the launch file that `start` launches."""
        self.parent = ROSLaunchParent("", [f])

    def start(self) -> None:
        """Start a master if none responds, and launch the file."""
        if not rosgraph.is_master_online():
            self._core = Process("core", ["core"])
            while not rosgraph.is_master_online():
                if not self._core.is_alive():
                    raise RLException("no master could be started")
                time.sleep(0.05)
        if self.parent is not None:
            self.parent.start()
        self.started = True

    def launch(self, node: Node) -> Process:
        """Start a node.

        Raises:
            RLException: `start` was not called.
        """
        if not self.started:
            raise RLException("please start ROSLaunch first")
        prefix = ["--prefix", node.launch_prefix] if node.launch_prefix else []
        words = ["exec", *prefix, node.package, node.type, *shlex.split(node.args)]
        words += [f"{old}:={new}" for old, new in node.remap_args]
        words += [f"__name:={node.name}"] if node.name else []
        env = dict(node.env_args)
        if node.namespace != "/":
            env["ROS_NAMESPACE"] = node.namespace
        process = Process(node.name or node.type, words, env)
        process.package = node.package
        self._processes.append(process)
        return process

    def stop(self) -> None:
        """Stop all nodes and the master."""
        for process in reversed(self._processes):
            process.stop()
        if self.parent is not None:
            self.parent.shutdown()
        if self._core is not None:
            self._core.stop()
        self._processes.clear()
        self.started = False

    def spin(self) -> None:
        """Wait until all nodes have ended, or Ctrl-C."""
        try:
            for process in self._processes:
                process.wait()
            if self.parent is not None:
                self.parent.spin()
        except KeyboardInterrupt:
            self.stop()

    def spin_once(self) -> None:
        """Wait for a short time."""
        time.sleep(0.1)
