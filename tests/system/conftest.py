"""Runs the `trundle` command as a user does: a process of its own."""

import contextlib
import os
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path

import pytest

from trundle.ros import MasterProxy, MasterUnreachableError

TIMEOUT_S = 60.0


class Running:
    """A `trundle` process in the background."""

    def __init__(self, arguments: Sequence[str], env: Mapping[str, str], cwd: Path) -> None:
        self.log = cwd / f"{arguments[0]}.log"
        with self.log.open("wb") as log:
            self.process = subprocess.Popen(
                [sys.executable, "-m", "trundle", *arguments], env=dict(env), cwd=cwd, stdout=log, stderr=log
            )

    def output(self) -> str:
        return self.log.read_text(errors="replace")

    def interrupt(self) -> int:
        """Ctrl-C; return the exit code."""
        self.process.send_signal(signal.SIGINT)
        return self.process.wait(TIMEOUT_S)


@pytest.fixture
def env(tmp_path: Path) -> dict[str, str]:
    """A user's environment with nothing of ROS in it but a port of the test's own."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    kept = {key: value for key, value in os.environ.items() if not key.startswith(("ROS_", "GAZEBO_", "TRUNDLE_"))}
    return {**kept, "HOME": str(tmp_path), "ROS_MASTER_URI": f"http://127.0.0.1:{port}"}


@pytest.fixture
def trundle(env: dict[str, str], tmp_path: Path) -> Callable[..., subprocess.CompletedProcess[str]]:
    """Run a command to its end."""

    def call(*arguments: str, **more: str) -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            [sys.executable, "-m", "trundle", *arguments],
            env={**env, **more},
            cwd=tmp_path,
            capture_output=True,
            text=True,
            timeout=TIMEOUT_S,
            check=False,
        )

    return call


@pytest.fixture
def start(env: dict[str, str], tmp_path: Path) -> Iterator[Callable[..., Running]]:
    """Start a command in the background; it is killed when the test ends."""
    started: list[Running] = []

    def call(*arguments: str, **more: str) -> Running:
        running = Running(arguments, {**env, **more}, tmp_path)
        started.append(running)
        return running

    yield call
    for running in started:
        running.process.kill()
        running.process.wait()


@pytest.fixture
def master(env: dict[str, str]) -> MasterProxy:
    """The master of the test's environment, which may not be up yet."""
    return MasterProxy(env["ROS_MASTER_URI"], caller_id="/test")


@pytest.fixture
def until() -> Callable[[str, Callable[[], object]], None]:
    """Wait until a condition holds; a master that is not up yet counts as False."""

    def wait(what: str, is_so: Callable[[], object]) -> None:
        end = time.monotonic() + TIMEOUT_S
        while True:
            with contextlib.suppress(MasterUnreachableError):
                if is_so():
                    return
            assert time.monotonic() < end, f"waited {TIMEOUT_S:g} s for {what}"
            time.sleep(0.05)

    return wait
