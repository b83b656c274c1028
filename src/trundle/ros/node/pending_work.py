"""Work in progress of this process's nodes, which a simulation in lockstep waits for."""

import time
from collections.abc import Generator
from contextlib import contextmanager

from trundle.base.waiting import PERIOD_S, waiting_line

_MAX_SHOWN = 3
"""Maximum number of items in one notice."""


class WorkItem:
    """One piece of work in progress."""

    __slots__ = ("description", "is_answer", "start_s")

    def __init__(self, description: str, *, is_answer: bool) -> None:
        self.description = description
        """Noun phrase for the notice, such as "the answer of /spawn"; empty: in no notice."""
        self.is_answer = is_answer
        """True for the answer of a service or another program, which may itself wait for time to pass."""
        self.start_s = time.monotonic()


class PendingWork:
    """Tracks work that can end while simulated time stands still, such as master and service calls; thread-safe."""

    def __init__(self) -> None:
        self._items: set[WorkItem] = set()
        self.changes = 0
        """Number of starts and ends so far."""
        self._noticed_s = 0.0

    def start(self, description: str = "", *, is_answer: bool = False) -> WorkItem:
        """Begin work; returns it for `finish`.

        Args:
            description: noun phrase for the notice, such as "the ROS master's answer to registerService".
            is_answer: True for the answer of a service or another program, which may itself wait for time to pass.
        """
        work = WorkItem(description, is_answer=is_answer)
        self.changes += 1
        self._items.add(work)
        return work

    def finish(self, work: WorkItem) -> None:
        """End work."""
        self.changes += 1
        self._items.discard(work)

    @contextmanager
    def pending(self, description: str = "", *, is_answer: bool = False) -> Generator[None]:
        """Track the work in the context."""
        work = self.start(description, is_answer=is_answer)
        try:
            yield
        finally:
            self.finish(work)

    @property
    def is_busy(self) -> bool:
        """True if any work is in progress."""
        return bool(self._items)

    @property
    def awaits_only_answers(self) -> bool:
        """True if work is in progress and all of it is answers."""
        items = list(self._items)
        return bool(items) and all(item.is_answer for item in items)

    def abandon_answers(self) -> list[str]:
        """Stop tracking the pending answers; return their descriptions."""
        answers = [item for item in list(self._items) if item.is_answer]
        self._items.difference_update(answers)
        return list(dict.fromkeys(item.description for item in answers))

    def notice(self) -> str | None:
        """Return a line on the work that takes more than a few seconds, every few seconds; else None."""
        now_s = time.monotonic()
        items = sorted((item for item in list(self._items) if item.description), key=lambda item: item.start_s)
        names = list(dict.fromkeys(item.description for item in items if now_s - item.start_s >= PERIOD_S))
        if not names or now_s < self._noticed_s + PERIOD_S:
            return None
        self._noticed_s = now_s
        more = f" and {len(names) - _MAX_SHOWN} more" if len(names) > _MAX_SHOWN else ""
        return waiting_line("; ".join(names[:_MAX_SHOWN]) + more, now_s - items[0].start_s)
