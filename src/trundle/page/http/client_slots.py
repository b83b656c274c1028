"""Limits of connected clients: view-only clients do not use up the slots of others."""

from collections.abc import Callable, Generator
from contextlib import contextmanager

MAX_CONTROLLING = 40
MAX_VIEW_ONLY = 60


class ClientSlots:
    """Clients of one server, with full access and view-only."""

    def __init__(self) -> None:
        self._controlling = 0
        self._view_only: list[Callable[[], object]] = []
        """Functions that disconnect each view-only client, oldest first."""

    def has_room(self, *, is_view_only: bool) -> bool:
        """True if another client can connect; a view-only one always can."""
        return is_view_only or self._controlling < MAX_CONTROLLING

    @contextmanager
    def occupied(self, end: Callable[[], object], *, is_view_only: bool) -> Generator[None]:
        """Occupy a slot in the context; `end` disconnects the client when newer view-only clients need its slot."""
        if not is_view_only:
            self._controlling += 1
            try:
                yield
            finally:
                self._controlling -= 1
            return
        if len(self._view_only) >= MAX_VIEW_ONLY:
            self._view_only.pop(0)()
        self._view_only.append(end)
        try:
            yield
        finally:
            if end in self._view_only:
                self._view_only.remove(end)
