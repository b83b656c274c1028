"""Work in progress of this process's nodes, which a simulation in lockstep waits for."""

from collections.abc import Callable, Generator
from contextlib import contextmanager


class PendingWork:
    """Tracks work that finishes without time passing: master calls, service calls, connecting; thread-safe."""

    def __init__(self) -> None:
        self._under_way: set[object] = set()
        self._asked: list[Callable[[], bool]] = []

    def start(self) -> object:
        """Begin work; returns a token for `finish`."""
        token = object()
        self._under_way.add(token)
        return token

    def finish(self, token: object) -> None:
        """End work."""
        self._under_way.discard(token)

    @contextmanager
    def pending(self) -> Generator[None]:
        """Track the work in the context."""
        token = self.start()
        try:
            yield
        finally:
            self.finish(token)

    def add_source(self, is_busy: Callable[[], bool]) -> None:
        """Add a function that reports other work in progress."""
        self._asked.append(is_busy)

    @property
    def is_busy(self) -> bool:
        """True if any work is in progress."""
        return bool(self._under_way) or any(is_busy() for is_busy in self._asked)

    def abandon(self) -> None:
        """Forget all current work."""
        self._under_way.clear()
