"""A launch in this process, at a master that is there."""

from collections.abc import Coroutine
from pathlib import Path
from typing import Any

import pytest
from tests.graphs import running_graph

from trundle.cli.main import main
from trundle.ros import GraphLoop


def test_nodes_have_as_long_as_they_need_to_start(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A large launch on a busy machine takes minutes."""
    run = GraphLoop.run

    def hasten(loop: GraphLoop, coroutine: Coroutine[Any, Any, Any], timeout_s: float | None = 30.0) -> Any:
        is_limited_start = timeout_s is not None and coroutine.__qualname__ == "RunningNodes.start"
        return run(loop, coroutine, 0.0 if is_limited_start else timeout_s)

    (tmp_path / "a.launch").write_text('<launch><param name="a" value="1"/></launch>')
    with running_graph() as graph:
        monkeypatch.setenv("ROS_MASTER_URI", graph.core.uri)
        monkeypatch.setattr(GraphLoop, "run", hasten)

        assert main(["launch", "--headless", str(tmp_path / "a.launch")]) == 0
