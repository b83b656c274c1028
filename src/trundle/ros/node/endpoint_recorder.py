"""What a thread has a node begin, so that it can be ended again before the node is."""

import threading
from collections.abc import Generator
from contextlib import contextmanager
from typing import Protocol


class Endpoint(Protocol):
    """A node's end of a topic or a service."""

    def unregister(self) -> None:
        """Have no part in it any more."""


class EndpointRecorder(threading.local):
    """A list for each thread that asked for one."""

    def __init__(self) -> None:
        self._ends: list[Endpoint] | None = None

    def add(self, end: Endpoint) -> None:
        """Note what was begun, or asked for again, if this thread wants to know."""
        if self._ends is not None:
            self._ends.append(end)

    @contextmanager
    def record(self) -> Generator[list[Endpoint]]:
        """Note what this thread begins from now on."""
        self._ends = ends = list[Endpoint]()
        try:
            yield ends
        finally:
            self._ends = None
