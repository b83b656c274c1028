"""A graph for each test, stand-ins that run on it, and a client node."""

import asyncio
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import Future
from dataclasses import replace
from typing import Any

import pytest
from tests.graphs import PATIENCE_S, running_graph, until

from trundle.base.supervisor import ProcessTree
from trundle.gazebo.nodes import BuiltinReplacement, NodeHost, run_builtin_node
from trundle.gazebo.nodes.catalog import BUILTIN_NODES
from trundle.robots.names import parse_arguments
from trundle.ros import GraphLoop, Message, Messages, Node, Publisher

_CLOSE_DELAY_S = 0.1
"""Time for the last connections of ended processes [s]: a half-accepted one would leak when the loop ends."""


class NodeGraph:
    """A graph with a running master, a client and the stand-ins that a test starts."""

    def __init__(self, loop: GraphLoop, uri: str, client: Node | None = None) -> None:
        self.loop = loop
        self.uri = uri
        self.client = client or Node("/client", loop=loop, master_uri=uri)
        self._running: list[tuple[Future[int], Node]] = []
        self._tree = ProcessTree()

    def start(
        self, program: str, arguments: str = "", *, name: str = "", host: NodeHost | None = None, **params: Any
    ) -> Future[int]:
        """Start `package/type` as a launch would; the future is its exit code."""
        package, _, type_name = program.partition("/")
        parsed = parse_arguments(arguments.split())
        node = Node(
            name or type_name.removesuffix(".py"),
            loop=self.loop,
            master_uri=self.uri,
            remappings=parsed.remappings,
            params={**parsed.params, **params},
        )
        stand_in = BuiltinReplacement(BUILTIN_NODES[package, type_name])
        future = self.loop.spawn(
            run_builtin_node(stand_in, node, list(parsed.rest), replace(host or NodeHost(), tree=self._tree))
        )
        self._running.append((future, node))
        return future

    def listen(self, topic: str, type_name: str) -> list[Message]:
        """Collect a topic's messages from now on."""
        messages: list[Message] = []
        self.client.subscribe(topic, type_name, messages.append, queue_size=None)
        return messages

    def advertise(self, topic: str, type_name: str, *, latch: bool = False) -> Publisher:
        """Return a function that publishes on a topic, once it has a subscriber; at once if latched."""
        publisher = self.client.advertise(topic, type_name, queue_size=None, latch=latch)
        if not latch:
            self.until(lambda: publisher.has_subscribers)
        return publisher

    def call(self, service: str, type_name: str, **fields: Any) -> Message:
        """Call a service as soon as it is advertised."""
        self.loop.run(self.client.wait_for_service(service, PATIENCE_S), PATIENCE_S + 5.0)
        return self.loop.run(self.client.call_service(service, type_name, fields), PATIENCE_S)

    def set_params(self, params: Mapping[str, Any]) -> None:
        """Set parameters by their global names."""
        for name, value in params.items():
            self.loop.run(self.client.params.set(name, value))

    def until(self, condition: Callable[[], object]) -> None:
        """Wait until a condition on the graph holds."""
        until(condition)

    def stop(self) -> None:
        """Cancel every stand-in, and wait for each."""

        async def end() -> None:
            for future, _ in self._running:
                future.cancel()
            for _, node in self._running:
                await node.closed.wait()
            await asyncio.sleep(_CLOSE_DELAY_S)

        self.loop.run(end(), PATIENCE_S)
        self._running.clear()
        self._tree.close()

    def connected(self, topic: str) -> bool:
        """Return True if the client is connected to a publisher of a topic."""
        return any(link[4] == topic and link[2] == "i" for link in self.client.endpoints.connections())

    def linked(self, topic: str) -> bool:
        """Return True if a stand-in's topic has a subscriber."""
        return any(
            link[4] == topic and link[2] == "o" for _, node in self._running for link in node.endpoints.connections()
        )


@pytest.fixture(scope="session")
def messages() -> Messages:
    return Messages()


@pytest.fixture
def graph(messages: Messages) -> Iterator[NodeGraph]:
    with running_graph(messages) as core_graph:
        node_graph = NodeGraph(core_graph.loop, core_graph.core.uri)
        yield node_graph
        node_graph.stop()
