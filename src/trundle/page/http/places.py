"""Places of clients: a crowd that may only look takes none from those who may do more."""

from collections.abc import Callable, Generator
from contextlib import contextmanager

MAX_CONTROLLING = 40
MAX_LOOKING = 60


class Places:
    """Clients of one server, by what they may do."""

    def __init__(self) -> None:
        self._controlling = 0
        self._looking: list[Callable[[], object]] = []
        """Functions that end each client that may only look, oldest first."""

    def has_room(self, *, is_view_only: bool) -> bool:
        """True if a client can be served; one that may only look always can."""
        return is_view_only or self._controlling < MAX_CONTROLLING

    @contextmanager
    def taken(self, end: Callable[[], object], *, is_view_only: bool) -> Generator[None]:
        """Take a place for a while; `end` ends the client, as happens to the oldest one that may only look."""
        if not is_view_only:
            self._controlling += 1
            try:
                yield
            finally:
                self._controlling -= 1
            return
        if len(self._looking) >= MAX_LOOKING:
            self._looking.pop(0)()
        self._looking.append(end)
        try:
            yield
        finally:
            if end in self._looking:
                self._looking.remove(end)
