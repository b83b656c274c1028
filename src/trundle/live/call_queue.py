"""Queue of functions from other threads; the simulation's thread calls them between two strides."""

from collections import deque
from collections.abc import Callable

from trundle.ros import GraphLoop, WorkItem


class CallQueue:
    """FIFO of functions; each counts as pending work of the graph's loop until it has run."""

    def __init__(self, loop: GraphLoop) -> None:
        self._loop = loop
        self._waiting: deque[tuple[Callable[[], object], WorkItem]] = deque()
        """(function, its entry in the loop's pending work)."""

    def post(self, call: Callable[[], object]) -> None:
        """Queue a function; from any thread."""
        self._waiting.append((call, self._loop.work.start("the simulation's next step")))

    def has_pending(self) -> bool:
        """True if a function is queued."""
        return bool(self._waiting)

    def run_pending(self) -> None:
        """Call the functions queued so far."""
        for _ in range(len(self._waiting)):
            call, token = self._waiting.popleft()
            try:
                call()
            finally:
                self._loop.end_batch()
                self._loop.work.finish(token)

    def clear(self) -> None:
        """Drop the queued functions: their thread has ended."""
        while self._waiting:
            self._loop.work.finish(self._waiting.popleft()[1])
