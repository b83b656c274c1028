"""Commands and callbacks of other threads, called between two steps of a simulation."""

from collections import deque
from collections.abc import Callable
from typing import Generic, TypeAlias, TypeVar

Repeat: TypeAlias = Callable[[], object]
"""Function that repeats the effect of an input from outside, such as a message."""
Owner = TypeVar("Owner")


class Inputs(Generic[Owner]):
    """Queue of one simulation; `post` and `post_callback` are thread-safe."""

    def __init__(self, owner: Owner) -> None:
        """Create an empty queue; each command is called with `owner`."""
        self._owner = owner
        self._waiting: deque[tuple[Callable[[Owner], object], bool]] = deque()
        """(command, True if a caller waits for its result)."""
        self.record: Callable[[Repeat], None] | None = None
        """Called after each input from outside, with a function that repeats it."""

    def post(self, command: Callable[[Owner], object]) -> None:
        """Queue a command."""
        self._waiting.append((command, False))

    def post_callback(self, callback: Callable[[], Repeat | None]) -> None:
        """Queue a callback that may come from outside the simulation, such as a message's.

        Args:
            callback: returns a function that repeats it; None: a repeated simulation calls it again by itself.
        """
        self.post(lambda _: self.call(callback))

    def post_call(self, callback: Callable[[], Repeat | None]) -> None:
        """Queue a callback whose result a caller waits for; as `post_callback`, but `run_calls` calls it, too."""
        self._waiting.append((lambda _: self.call(callback), True))

    def call(self, callback: Callable[[], Repeat | None]) -> None:
        """Call a callback at once; see `post_callback`."""
        repeat = callback()
        if repeat is not None and self.record is not None:
            self.record(repeat)

    def run(self) -> bool:
        """Call the commands queued before; return True if there were any."""
        count = len(self._waiting)
        for _ in range(count):
            self._waiting.popleft()[0](self._owner)
        return count > 0

    def run_calls(self) -> None:
        """Call only the callbacks of `post_call`, while the simulation is paused; all others keep their order."""
        queued = [self._waiting.popleft() for _ in range(len(self._waiting))]
        self._waiting.extendleft(reversed([entry for entry in queued if not entry[1]]))
        for command, is_call in queued:
            if is_call:
                command(self._owner)
