"""Flat out, time goes on only when the nodes of this process have done what there was to do: runs repeat."""

import threading
import time
from collections.abc import Callable

from trundle.ros import GraphLoop, StepRecorder

_STARTING_PASSES = 50
"""Starting nodes do more between two calls than running ones."""
START_S = 30.0
"""How long nodes may take, in all, to start."""
_REST_S = 10.0
_TURN_S = 0.2
"""How long a wait is at most before the simulation's thread looks whether it is to end."""


class Lockstep:
    """Holds time at zero while a launch starts, at each step until all is done, and at the end."""

    def __init__(
        self, loop: GraphLoop, *, end_ns: int | None, recorder: StepRecorder | None, say: Callable[[str], None]
    ) -> None:
        """Hold time.

        Args:
            loop: of the nodes.
            end_ns: where time stops for good [ns]; None: nowhere.
            recorder: writes what was said after each step.
            say: tells the user of a wait that was in vain.
        """
        self._loop = loop
        self._end_ns = end_ns
        self._recorder = recorder
        self._say: Callable[[str], None] | None = say
        self._due = time.monotonic() + START_S
        self._begun = threading.Event()
        self.over = threading.Event()
        """Set when the end is reached and everything up to it is written."""

    async def wait_started(self, is_ending: Callable[[], bool]) -> None:
        """Wait, on the loop, until what was started so far has come to rest; in all, for half a minute at most.

        Args:
            is_ending: whether to come back at once.
        """
        remaining_s = max(0.0, self._due - time.monotonic())
        has_rested = await self._loop.idle(remaining_s, unless=is_ending, passes=_STARTING_PASSES)
        if not has_rested and not is_ending():
            self._give_up()

    def start(self) -> None:
        """Let time pass."""
        self._begun.set()

    @property
    def is_ready(self) -> bool:
        """Whether time may pass now."""
        return self._begun.is_set() and not self.over.is_set()

    def target_ns(self, wanted_ns: int) -> int:
        """How far time may go [ns]."""
        return wanted_ns if self._end_ns is None else min(wanted_ns, self._end_ns)

    def wait_settled(
        self, obey: Callable[[], None], is_called: Callable[[], bool], is_ending: Callable[[], bool]
    ) -> None:
        """Wait until the nodes have done what there was to do.

        Args:
            obey: does what nodes asked the simulation for.
            is_called: whether they have.
            is_ending: whether to come back at once.
        """
        due = time.monotonic() + _REST_S
        while not is_ending():
            obey()
            if self._loop.wait_idle(_TURN_S, unless=is_called) and not is_called():
                return
            if time.monotonic() > due:
                self._give_up()
                return

    def record_step(self, time_ns: int) -> None:
        """Write what was said up to a time [ns] at which all is settled."""
        if self._recorder is not None:
            self._recorder.write(time_ns)
        if self._end_ns is not None and time_ns >= self._end_ns:
            self.over.set()

    def _give_up(self) -> None:
        self._loop.work.abandon()
        if self._say is not None:
            self._say(
                "a node keeps waiting while time stands still; time goes on, but another run may differ from this"
            )
            self._say = None
