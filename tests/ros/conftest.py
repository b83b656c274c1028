"""A graph of its own for each test: a loop, a master at a free port, and nodes that are shut down at the end."""

import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import pytest

from trundle.ros import Core, GraphLoop, Messages, Node

PATIENCE_S = 60.0
"""How long anything may take on a busy machine before a test gives up."""


@pytest.fixture(scope="session")
def messages() -> Messages:
    return Messages()


@dataclass
class Graph:
    """A running master with nodes."""

    loop: GraphLoop
    core: Core

    def node(self, name: str, **options: Any) -> Node:
        return Node(name, loop=self.loop, master_uri=self.core.uri, **options)

    def ready(self, *nodes: Node) -> None:
        for node in nodes:
            self.loop.run(node.ready(), PATIENCE_S)

    def until(self, condition: Callable[[], object]) -> None:
        """Wait for something that the loop brings about."""
        end = time.monotonic() + PATIENCE_S
        while not condition():
            assert time.monotonic() < end, "waited in vain"
            time.sleep(0.002)


@pytest.fixture
def graph(messages: Messages, monkeypatch: pytest.MonkeyPatch) -> Iterator[Graph]:
    for variable in ("ROS_MASTER_URI", "ROS_IP", "ROS_HOSTNAME", "ROS_NAMESPACE"):
        monkeypatch.delenv(variable, raising=False)
    with GraphLoop(messages=messages) as loop:
        core = Core(loop, port=0)
        loop.run(core.start(), PATIENCE_S)
        loop.run(core.ready(), PATIENCE_S)
        running = Graph(loop, core)
        yield running
        loop.run(running.core.stop(), PATIENCE_S)


@pytest.fixture
def far(graph: Graph, messages: Messages) -> Iterator[Graph]:
    """The same graph from a second loop: nodes there are reached over sockets, as in another process."""
    with GraphLoop(messages=messages) as loop:
        yield Graph(loop, graph.core)
