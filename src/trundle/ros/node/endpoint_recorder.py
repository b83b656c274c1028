"""Per-thread record of created publishers, subscriptions and services, for unregistering them together."""

import threading
from collections.abc import Generator
from contextlib import contextmanager
from typing import Protocol


class Endpoint(Protocol):
    """A publisher, subscription or service of a node."""

    def unregister(self) -> None:
        """Unregister at node and master."""


class EndpointRecorder(threading.local):
    """Thread-local list of endpoints."""

    def __init__(self) -> None:
        self._endpoints: list[Endpoint] | None = None

    def add(self, endpoint: Endpoint) -> None:
        """Record an endpoint that this thread created or requested again, if recording."""
        if self._endpoints is not None:
            self._endpoints.append(endpoint)

    @contextmanager
    def record(self) -> Generator[list[Endpoint]]:
        """Record the endpoints this thread creates in the context; an outer context records them, too."""
        outer, self._endpoints = self._endpoints, list[Endpoint]()
        endpoints = self._endpoints
        try:
            yield endpoints
        finally:
            self._endpoints = outer
            if outer is not None:
                outer += endpoints
