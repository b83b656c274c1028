"""ROS graph for commands."""

import subprocess
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest
from tests import graphs
from tests.graphs import PATIENCE_S as PATIENCE_S

from trundle.app.cli import main


@dataclass
class Graph(graphs.Graph):
    """Running master at ROS_MASTER_URI, and nodes registered with it."""

    capsys: pytest.CaptureFixture[str]

    def trundle(self, *arguments: str) -> tuple[int, str, str]:
        """Run a command in this process; return exit code, standard output and standard error."""
        self.capsys.readouterr()
        code = main(arguments)
        out, error = self.capsys.readouterr()
        return code, out, error


@pytest.fixture
def graph(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Iterator[Graph]:
    with graphs.running_graph() as running:
        monkeypatch.setenv("ROS_MASTER_URI", running.core.uri)
        yield Graph(running.loop, running.core, capsys)


@pytest.fixture
def no_master(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROS_MASTER_URI", "http://127.0.0.1:9/")


@pytest.fixture
def original(graph: Graph, tmp_path: Path) -> Callable[..., str]:
    """Debian's ROS 1 tools on the same graph: `original("rostopic", "list")` returns their output.

    Their exit code must be 0, or the argument `code`.
    """
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

    def run(command: str, *arguments: str, stdin: str | None = None, path: Path | None = None, code: int = 0) -> str:
        process = subprocess.run(
            [f"/usr/bin/{command}", *arguments],
            env={**environment, **({"ROS_PACKAGE_PATH": str(path)} if path else {})},
            input=stdin,
            capture_output=True,
            text=True,
            timeout=100,
            check=False,
        )
        assert process.returncode == code, process.stdout + process.stderr
        return process.stdout

    return run
