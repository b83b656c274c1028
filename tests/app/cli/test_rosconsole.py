"""Debian's rosconsole with a Trundle node."""

from typing import Any

import pytest

from trundle.ros import Loggers


@pytest.mark.slow
@pytest.mark.real_ros
def test_rosconsole_lists_and_sets(graph: Any, original: Any, capsys: pytest.CaptureFixture[str]) -> None:
    node = graph.node("cpp")
    node.log.loggers = Loggers.for_roscpp("topic_tools")
    graph.ready(node)
    assert "ros\nros.roscpp\n" in original("rosconsole", "list", "/cpp")
    node.log.debug("not yet")
    original("rosconsole", "set", "/cpp", "ros", "debug")
    node.log.debug("now")
    assert original("rosconsole", "get", "/cpp", "ros.topic_tools") == "debug\n"
    error = capsys.readouterr().err
    assert "now" in error
    assert "not yet" not in error
