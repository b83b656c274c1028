"""Nodes and processes."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Sequence

import rosgraph
from rosgraph.names import make_global_ns

DEFAULT_MASTER_PORT = 11311
_STOP_S = (15.0, 2.0)
"""Waits after SIGINT and SIGTERM."""


class RLException(Exception):
    """A launch cannot start."""


class Master:
    """The master that launches use."""

    def __init__(self, type_: str | None = None, uri: str | None = None) -> None:
        self.type = type_ or "rosmaster"
        self.uri = uri or rosgraph.get_master_uri() or ""

    def is_running(self) -> bool:
        """True if it answers."""
        return rosgraph.is_master_online(self.uri)


class Node:
    """A node to start."""

    def __init__(
        self,
        package: str,
        node_type: str,
        name: str | None = None,
        namespace: str = "/",
        machine_name: str | None = None,
        args: str = "",
        respawn: bool = False,
        respawn_delay: float = 0.0,
        remap_args: Sequence[tuple[str, str]] | None = None,
        env_args: Sequence[tuple[str, str]] | None = None,
        output: str | None = None,
        cwd: str | None = None,
        launch_prefix: str | None = None,
        required: bool = False,
        filename: str = "<unknown>",
    ) -> None:
        self.package = package
        self.type = node_type
        self.name = name
        self.namespace = make_global_ns(namespace or "/")
        self.machine_name = machine_name
        self.args = args or ""
        self.respawn = respawn
        self.respawn_delay = respawn_delay
        self.remap_args = list(remap_args or ())
        self.env_args = list(env_args or ())
        self.output = output or "log"
        self.cwd = cwd
        self.launch_prefix = launch_prefix
        self.required = required
        self.filename = filename


class Process:
    """A `trundle` command that runs."""

    def __init__(self, name: str, arguments: Sequence[str], env: dict[str, str] | None = None) -> None:
        """Start it."""
        self.name = name
        self.args = [sys.executable, "-m", "trundle", *arguments]
        self.package: str | None = None
        self._process = subprocess.Popen(self.args, env={**os.environ, **(env or {})}, start_new_session=True)
        self.pid = self._process.pid

    @property
    def exit_code(self) -> int | None:
        """Exit code; None while it runs."""
        return self._process.poll()

    def is_alive(self) -> bool:
        """True while it runs."""
        return self._process.poll() is None

    def stop(self, errors: list[str] | None = None) -> None:
        """Stop it as Ctrl-C does, then by force."""
        del errors
        for number, wait_s in zip((signal.SIGINT, signal.SIGTERM), _STOP_S, strict=True):
            if not self.is_alive():
                return
            self._process.send_signal(number)
            try:
                self._process.wait(wait_s)
            except subprocess.TimeoutExpired:
                continue
        self._process.kill()
        self._process.wait()

    def wait(self) -> None:
        """Wait for its end."""
        while self.is_alive():
            time.sleep(0.1)
