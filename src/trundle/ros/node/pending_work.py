"""Work in progress of this process's nodes, which a simulation in lockstep waits for."""

import time
from collections.abc import Generator
from contextlib import contextmanager

from trundle.base.waiting import PERIOD_S, waiting_line

_MAX_SHOWN = 3
"""Most kinds of work that one notice names."""


class WorkItem:
    """One piece of work in progress."""

    __slots__ = ("is_answer", "start_s", "what")

    def __init__(self, what: str, *, is_answer: bool) -> None:
        self.what = what
        """Noun of what is waited for; empty: other work says so."""
        self.is_answer = is_answer
        """True if it is another's answer, which may need time to pass."""
        self.start_s = time.monotonic()


class PendingWork:
    """Tracks work that finishes without time passing: master calls, service calls, connecting; thread-safe."""

    def __init__(self) -> None:
        self._under_way: set[WorkItem] = set()
        self.changes = 0
        """Number of starts and ends so far."""
        self._noticed_s = 0.0

    def start(self, what: str = "", *, is_answer: bool = False) -> WorkItem:
        """Begin work; returns it for `finish`.

        Args:
            what: noun of what is waited for, such as "the ROS master's answer to registerService".
            is_answer: True for the answer of a service or another program, which may itself wait for time to pass.
        """
        work = WorkItem(what, is_answer=is_answer)
        self.changes += 1
        self._under_way.add(work)
        return work

    def finish(self, work: WorkItem) -> None:
        """End work."""
        self.changes += 1
        self._under_way.discard(work)

    @contextmanager
    def pending(self, what: str = "", *, is_answer: bool = False) -> Generator[None]:
        """Track the work in the context."""
        work = self.start(what, is_answer=is_answer)
        try:
            yield
        finally:
            self.finish(work)

    @property
    def is_busy(self) -> bool:
        """True if any work is in progress."""
        return bool(self._under_way)

    @property
    def awaits_only_answers(self) -> bool:
        """True if all work in progress is others' answers, and there is some."""
        work = list(self._under_way)
        return bool(work) and all(each.is_answer for each in work)

    def abandon_answers(self) -> list[str]:
        """Count the answers awaited now no more; return their names."""
        answers = [each for each in list(self._under_way) if each.is_answer]
        self._under_way.difference_update(answers)
        return list(dict.fromkeys(each.what for each in answers))

    def notice(self) -> str | None:
        """Return a line on the work that takes more than a few seconds, every few seconds; else None."""
        now_s = time.monotonic()
        old = sorted((each for each in list(self._under_way) if each.what), key=lambda each: each.start_s)
        names = list(dict.fromkeys(each.what for each in old if now_s - each.start_s >= PERIOD_S))
        if not names or now_s < self._noticed_s + PERIOD_S:
            return None
        self._noticed_s = now_s
        more = f" and {len(names) - _MAX_SHOWN} more" if len(names) > _MAX_SHOWN else ""
        return waiting_line("; ".join(names[:_MAX_SHOWN]) + more, now_s - old[0].start_s)
