"""Commands and callbacks of other threads, called between two steps of a simulation."""

from collections import deque
from collections.abc import Callable
from typing import Generic, TypeAlias, TypeVar

Repeat: TypeAlias = Callable[[], object]
"""Does once more what an input from outside, such as a message, did."""
Owner = TypeVar("Owner")


class Inputs(Generic[Owner]):
    """Queue of one simulation; `post` and `post_callback` are thread-safe."""

    def __init__(self, owner: Owner) -> None:
        """Begin with none; commands are called with the owner."""
        self._owner = owner
        self._waiting: deque[Callable[[Owner], object]] = deque()
        self.record: Callable[[Repeat], None] | None = None
        """Takes what repeats each input from outside."""

    def post(self, command: Callable[[Owner], object]) -> None:
        """Queue a command."""
        self._waiting.append(command)

    def post_callback(self, callback: Callable[[], Repeat | None]) -> None:
        """Queue a callback that may come from outside the simulation, such as a message's.

        Args:
            callback: returns what repeats it; None: it comes again by itself if the simulation is repeated.
        """
        self.post(lambda _: self.call(callback))

    def call(self, callback: Callable[[], Repeat | None]) -> None:
        """Call a callback, as of `post_callback`, now."""
        repeat = callback()
        if repeat is not None and self.record is not None:
            self.record(repeat)

    def run(self) -> bool:
        """Call what was queued before this; return True if there was anything."""
        count = len(self._waiting)
        for _ in range(count):
            self._waiting.popleft()(self._owner)
        return count > 0
