"""Masters, parameters and processes; nodes and machines at their old path."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Sequence
from typing import Any

import rosgraph
from rosgraph.names import canonicalize_name
from rosgraph.network import parse_http_host_and_port

from .machine import Machine as Machine, is_machine_local as is_machine_local, local_machine as local_machine
from .node import Node as Node, Test as Test

DEFAULT_MASTER_PORT = 11311
_STOP_S = (15.0, 2.0)
"""Waits after SIGINT and SIGTERM [s]."""


class RLException(Exception):
    """A launch cannot start."""


class Master:
    """Master of a launch."""

    def __init__(self, type_: str | None = None, uri: str | None = None) -> None:
        self.type = type_ or "rosmaster"
        self.uri = uri or rosgraph.get_master_uri() or ""

    def get_host(self) -> str:
        """Host's name or address."""
        return parse_http_host_and_port(self.uri)[0]

    def get_port(self) -> int:
        """Port."""
        return parse_http_host_and_port(self.uri)[1]

    def is_running(self) -> bool:
        """True if the master responds."""
        return rosgraph.is_master_online(self.uri)


class Param:
    """A parameter to set."""

    def __init__(self, key: str, value: Any) -> None:
        self.key = canonicalize_name(key)
        self.value = value

    __hash__ = None  # pyright: ignore[reportAssignmentType] - it changes

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Param) and (self.key, self.value) == (other.key, other.value)

    def __repr__(self) -> str:
        return f"{self.key}={self.value}"


class Process:
    """Running `trundle` command."""

    def __init__(self, name: str, arguments: Sequence[str], env: dict[str, str] | None = None) -> None:
        """Start the command."""
        self.name = name
        self.args = [sys.executable, "-m", "trundle", *arguments]
        self.package: str | None = None
        self._process = subprocess.Popen(self.args, env={**os.environ, **(env or {})}, start_new_session=True)
        self.pid = self._process.pid

    @property
    def exit_code(self) -> int | None:
        """Exit code; None while the process runs."""
        return self._process.poll()

    def is_alive(self) -> bool:
        """True while the process runs."""
        return self._process.poll() is None

    def stop(self, errors: list[str] | None = None) -> None:
        """Interrupt the process as Ctrl-C does, then terminate and kill it."""
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
        """Wait for the end of the process."""
        while self.is_alive():
            time.sleep(0.1)
