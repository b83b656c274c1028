"""Clock for videos: it is held while a picture is taken, so that the video is smooth on any machine."""

import threading
import time

from trundle.spatial import NS_PER_S


class FilmClock:
    """Follows the wall clock until it is held, then advances by steps."""

    def __init__(self) -> None:
        self._changed = threading.Condition()
        self._held_ns: int | None = None
        self._due_ns: int | None = None
        """End of the simulation's sleep [ns]; None: it is awake."""

    def time_ns(self) -> int:
        """Return the time of the clock [ns]."""
        return time.monotonic_ns() if self._held_ns is None else self._held_ns

    def sleep(self, seconds: float) -> None:
        """Sleep for a duration of this clock; called by the simulation's thread."""
        with self._changed:
            self._due_ns = self.time_ns() + round(seconds * NS_PER_S)
            self._changed.notify_all()
            while (left_ns := self._due_ns - self.time_ns()) > 0:
                self._changed.wait(left_ns / NS_PER_S if self._held_ns is None else None)
            self._due_ns = None

    def hold(self) -> None:
        """Stop the clock."""
        with self._changed:
            self._held_ns = time.monotonic_ns()

    def advance(self, step_ns: int) -> None:
        """Advance by a step, and wait until the simulation has caught up."""
        with self._changed:
            assert self._held_ns is not None, "the clock is not held"
            self._held_ns += step_ns
            self._changed.notify_all()
            while self._due_ns is None or self._due_ns <= self._held_ns:
                self._changed.wait()

    def release(self) -> None:
        """Follow the wall clock again."""
        with self._changed:
            self._held_ns = None
            self._changed.notify_all()
