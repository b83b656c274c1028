"""What the nodes of this process have under way, so that a simulation in it can let them finish before time goes on."""

from collections.abc import Callable, Generator
from contextlib import contextmanager


class PendingWork:
    """Counts whatever ends without time passing: calls to the master, services, links being made; any thread."""

    def __init__(self) -> None:
        self._under_way: set[object] = set()
        self._asked: list[Callable[[], bool]] = []

    def start(self) -> object:
        """Count something; the result is handed to `end`."""
        token = object()
        self._under_way.add(token)
        return token

    def finish(self, token: object) -> None:
        """Count it no more."""
        self._under_way.discard(token)

    @contextmanager
    def pending(self) -> Generator[None]:
        """Count what happens inside."""
        token = self.start()
        try:
            yield
        finally:
            self.finish(token)

    def add_source(self, is_busy: Callable[[], bool]) -> None:
        """Have somebody asked who counts for themselves."""
        self._asked.append(is_busy)

    @property
    def is_busy(self) -> bool:
        """Whether anything is under way."""
        return bool(self._under_way) or any(is_busy() for is_busy in self._asked)

    def abandon(self) -> None:
        """Wait no more for what is under way now."""
        self._under_way.clear()
