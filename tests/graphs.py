"""A ROS graph for a test: a loop, a master at a free port, and nodes."""

import random
import socket
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

from trundle.ros import Core, GraphLoop, Messages, Node

PATIENCE_S = 180.0
"""Timeout of any wait on a busy machine [s]."""


def free_port() -> int:
    """Return a free port below the range from which the system takes ephemeral ports."""
    while True:
        with socket.socket() as probe:
            try:
                probe.bind(("127.0.0.1", random.randrange(20_000, 32_000)))
            except OSError:
                continue
            return int(probe.getsockname()[1])


def until(condition: Callable[[], object]) -> None:
    """Wait until another thread has made a condition true."""
    end = time.monotonic() + PATIENCE_S
    while not condition():
        assert time.monotonic() < end, "waited in vain"
        time.sleep(0.002)


@dataclass
class Graph:
    """A running master with nodes."""

    loop: GraphLoop
    core: Core

    def node(self, name: str, **options: Any) -> Node:
        return Node(name, loop=self.loop, master_uri=self.core.uri, **options)

    def ready(self, *nodes: Node) -> None:
        """Wait until all registrations of the nodes have reached the master."""
        for node in nodes:
            self.loop.run(node.wait_registered(), PATIENCE_S)

    def until(self, condition: Callable[[], object]) -> None:
        until(condition)


@contextmanager
def running_graph(messages: Messages | None = None) -> Iterator[Graph]:
    with GraphLoop(messages=messages) as loop:
        core = Core(loop, port=0)
        loop.run(core.start(), PATIENCE_S)
        loop.run(core.wait_ready(), PATIENCE_S)
        yield Graph(loop, core)
        loop.run(core.stop(), PATIENCE_S)
