"""Runs the `trundle` command in a process, like a user."""

import contextlib
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path

import pytest
from tests.graphs import free_port

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
        """Send SIGINT; return the exit code."""
        self.process.send_signal(signal.SIGINT)
        return self.process.wait(TIMEOUT_S)


@pytest.fixture
def env(tmp_path: Path) -> dict[str, str]:
    """A user's environment without ROS variables, except for a master's URI with the test's port."""
    variables = {key: value for key, value in os.environ.items() if not key.startswith(("ROS_", "GAZEBO_", "TRUNDLE_"))}
    return {**variables, "HOME": str(tmp_path), "ROS_MASTER_URI": f"http://127.0.0.1:{free_port()}"}


@pytest.fixture
def trundle(env: dict[str, str], tmp_path: Path) -> Callable[..., subprocess.CompletedProcess[str]]:
    """Run a command to its end."""

    def call(*arguments: str, **variables: str) -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            [sys.executable, "-m", "trundle", *arguments],
            env={**env, **variables},
            cwd=tmp_path,
            capture_output=True,
            text=True,
            timeout=TIMEOUT_S,
            check=False,
        )

    return call


@pytest.fixture
def start(env: dict[str, str], tmp_path: Path) -> Iterator[Callable[..., Running]]:
    """Start a command in the background; it is killed after the test."""
    started: list[Running] = []

    def call(*arguments: str, **variables: str) -> Running:
        running = Running(arguments, {**env, **variables}, tmp_path)
        started.append(running)
        return running

    yield call
    for running in started:
        running.process.kill()
        running.process.wait()


@pytest.fixture
def master(env: dict[str, str]) -> MasterProxy:
    """Proxy of the test's master, which may not run yet."""
    return MasterProxy(env["ROS_MASTER_URI"], caller_id="/test")


@pytest.fixture
def until() -> Callable[[str, Callable[[], object]], None]:
    """Wait until a condition is true; a master that does not run yet counts as False."""

    def wait(description: str, condition: Callable[[], object]) -> None:
        end = time.monotonic() + TIMEOUT_S
        while True:
            with contextlib.suppress(MasterUnreachableError):
                if condition():
                    return
            assert time.monotonic() < end, f"waited {TIMEOUT_S:g} s for {description}"
            time.sleep(0.05)

    return wait
