"""A graph of its own for each test: a loop, a master at a free port, and nodes that are shut down at the end."""

from collections.abc import Iterator

import pytest
from tests.graphs import PATIENCE_S as PATIENCE_S, Graph, running_graph

from trundle.ros import GraphLoop, Messages


@pytest.fixture(scope="session")
def messages() -> Messages:
    return Messages()


@pytest.fixture
def graph(messages: Messages) -> Iterator[Graph]:
    with running_graph(messages) as graph:
        yield graph


@pytest.fixture
def far(graph: Graph, messages: Messages) -> Iterator[Graph]:
    """The same graph from a second loop: nodes there are reached over sockets, as in another process."""
    with GraphLoop(messages=messages) as loop:
        yield Graph(loop, graph.core)
