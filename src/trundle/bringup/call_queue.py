"""What other threads want done on the simulation's: functions, called between two strides in the order they came."""

from collections import deque
from collections.abc import Callable

from trundle.ros import GraphLoop


class CallQueue:
    """A queue of functions, each under way on the graph until it is done."""

    def __init__(self, loop: GraphLoop) -> None:
        self._loop = loop
        self._waiting: deque[tuple[Callable[[], None], object]] = deque()
        """Each with what ends its being under way."""

    def post(self, call: Callable[[], None]) -> None:
        """Have a function called; from any thread."""
        self._waiting.append((call, self._loop.work.start()))

    def has_pending(self) -> bool:
        """Whether one waits."""
        return bool(self._waiting)

    def run_pending(self) -> None:
        """Call those that wait now."""
        for _ in range(len(self._waiting)):
            call, token = self._waiting.popleft()
            try:
                call()
            finally:
                self._loop.end_batch()
                self._loop.work.finish(token)

    def clear(self) -> None:
        """Forget those that wait: nobody is left to call them."""
        while self._waiting:
            self._loop.work.finish(self._waiting.popleft()[1])
