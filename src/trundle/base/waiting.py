"""Notices of waits without a time limit, printed every few seconds.

A busy, slow or suspended machine aborts no wait: docs/decisions/0026.
"""

import sys
import time
from collections.abc import Callable

PERIOD_S = 10.0
"""Time between two notices of one wait [s]."""


def print_line(line: str) -> None:
    """Print a line on standard error, if there is one."""
    if sys.stderr is not None:
        print(line, file=sys.stderr, flush=True)


class WaitNotice:
    """Prints every few seconds the awaited event and the duration of the wait; to be polled while waiting."""

    def __init__(self, what: str, say: Callable[[str], object] = print_line) -> None:
        """Start the wait.

        Args:
            what: the awaited event or object, such as "the page's server".
            say: prints a line.
        """
        self._what = what
        self._say = say
        self._start_s = time.monotonic()
        self._due_s = self._start_s + PERIOD_S

    def poll(self) -> None:
        """Print the notice, if it is due."""
        now_s = time.monotonic()
        if now_s >= self._due_s:
            self._due_s = now_s + PERIOD_S
            self._say(waiting_line(self._what, now_s - self._start_s))


def waiting_line(what: str, seconds: float) -> str:
    """Return the notice of a wait."""
    return f"waiting for {what} since {seconds:.0f} s"
