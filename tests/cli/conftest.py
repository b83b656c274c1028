"""A ROS graph for the commands that look at one."""

import subprocess
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from trundle.cli import main
from trundle.ros import Core, GraphLoop, Node

PATIENCE_S = 60.0


@dataclass
class Graph:
    """A running master that ROS_MASTER_URI names, and nodes on it."""

    loop: GraphLoop
    core: Core
    capsys: pytest.CaptureFixture[str]

    def node(self, name: str, **options: Any) -> Node:
        return Node(name, loop=self.loop, master_uri=self.core.uri, **options)

    def ready(self, *nodes: Node) -> None:
        for node in nodes:
            self.loop.run(node.ready(), PATIENCE_S)

    def until(self, condition: Callable[[], object]) -> None:
        end = time.monotonic() + PATIENCE_S
        while not condition():
            assert time.monotonic() < end, "waited in vain"
            time.sleep(0.002)

    def trundle(self, *arguments: str) -> tuple[int, str, str]:
        """Run a command in this process: exit code, standard output, standard error."""
        self.capsys.readouterr()
        code = main(arguments)
        return (code, *self.capsys.readouterr())


@pytest.fixture
def graph(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Iterator[Graph]:
    for variable in ("ROS_IP", "ROS_HOSTNAME", "ROS_NAMESPACE"):
        monkeypatch.delenv(variable, raising=False)
    with GraphLoop() as loop:
        core = Core(loop, port=0)
        loop.run(core.start(), PATIENCE_S)
        loop.run(core.ready(), PATIENCE_S)
        monkeypatch.setenv("ROS_MASTER_URI", core.uri)
        yield Graph(loop, core, capsys)
        loop.run(core.stop(), PATIENCE_S)


@pytest.fixture
def no_master(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROS_MASTER_URI", "http://127.0.0.1:9/")


@pytest.fixture
def original(graph: Graph, tmp_path: Path) -> Callable[..., str]:
    """Debian's own ROS 1 tools on the same graph: `original("rostopic", "list")` is what they print."""
    if not Path("/usr/bin/rostopic").exists():
        pytest.skip("Debian's ROS 1 tools are not installed")
    environment = {
        "PATH": "/usr/bin:/bin",
        "HOME": str(tmp_path),
        "ROS_MASTER_URI": graph.core.uri,
        "ROS_IP": "127.0.0.1",
        "ROS_DISTRO": "noetic",
        "PYTHONUNBUFFERED": "1",
        "PYTHONWARNINGS": "ignore",
    }

    def run(command: str, *arguments: str, typed: str | None = None, path: Path | None = None) -> str:
        done = subprocess.run(
            [f"/usr/bin/{command}", *arguments],
            env={**environment, **({"ROS_PACKAGE_PATH": str(path)} if path else {})},
            input=typed,
            capture_output=True,
            text=True,
            timeout=100,
            check=False,
        )
        assert done.returncode == 0, done.stdout + done.stderr
        return done.stdout

    return run
