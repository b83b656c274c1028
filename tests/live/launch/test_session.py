"""A launch in this process that joins a running master."""

from collections.abc import Coroutine
from pathlib import Path
from typing import Any

import pytest
from tests.graphs import running_graph

from trundle.app.cli.main import main
from trundle.ros import GraphLoop


def test_a_launch_waits_without_a_time_limit(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A large launch on a busy machine takes minutes; here every timeout expires at once."""
    run = GraphLoop.run

    def hasten(loop: GraphLoop, coroutine: Coroutine[Any, Any, Any], timeout_s: float | None = None) -> Any:
        return run(loop, coroutine, None if timeout_s is None else 0.0)

    (tmp_path / "a.launch").write_text('<launch><param name="a" value="1"/></launch>')
    with running_graph() as graph:
        monkeypatch.setenv("ROS_MASTER_URI", graph.core.uri)
        with monkeypatch.context() as hastened:
            hastened.setattr(GraphLoop, "run", hasten)
            assert main(["launch", "--headless", str(tmp_path / "a.launch")]) == 0
