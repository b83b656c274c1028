"""Lockstep of a run: time advances only when this process's nodes have settled, so that runs repeat."""

import threading
import time
from collections.abc import Callable

from trundle.ros import GraphLoop, StepRecorder

_STARTING_PASSES = 50
"""Passes of the idle loop that count as settled while nodes start: they do more between two calls."""
START_S = 30.0
"""Timeout of starting all nodes [s]."""
_REST_S = 10.0
_TURN_S = 0.2
"""Longest wait before the simulation's thread checks for the end [s]."""


class Lockstep:
    """Holds time at zero while a launch starts, at each step until the nodes have settled, and at the end."""

    def __init__(
        self,
        loop: GraphLoop,
        *,
        end_ns: int | None,
        recorder: StepRecorder | None,
        say: Callable[[str], None],
        settle: Callable[[], bool] | None = None,
    ) -> None:
        """Hold time at zero.

        Args:
            loop: loop of the nodes.
            end_ns: end of time [ns]; None: open.
            recorder: writes the messages of each step.
            say: prints that a wait timed out.
            settle: called at each time at which the nodes have settled; True is the end, too.
        """
        self._settle = settle
        self._loop = loop
        self._end_ns = end_ns
        self._recorder = recorder
        self._say: Callable[[str], None] | None = say
        self._due = time.monotonic() + START_S
        self._begun = threading.Event()
        self.over = threading.Event()
        """Set when the end is reached and recorded."""

    async def wait_started(self, is_ending: Callable[[], bool]) -> None:
        """Wait, on the loop, until the nodes started so far have settled; in all, for at most 30 s.

        Args:
            is_ending: True ends the wait.
        """
        remaining_s = max(0.0, self._due - time.monotonic())
        has_rested = await self._loop.idle(remaining_s, unless=is_ending, passes=_STARTING_PASSES)
        if not has_rested and not is_ending():
            self._give_up()

    def start(self) -> None:
        """Let time advance."""
        self._begun.set()

    @property
    def is_ready(self) -> bool:
        """True if time may advance now."""
        return self._begun.is_set() and not self.over.is_set()

    def rewind(self) -> None:
        """Let time advance again after the end, to the same one."""
        self.over.clear()

    def target_ns(self, wanted_ns: int) -> int:
        """Time to advance to [ns]: at most the end."""
        return wanted_ns if self._end_ns is None else min(wanted_ns, self._end_ns)

    def wait_settled(
        self, run_calls: Callable[[], None], is_called: Callable[[], bool], is_ending: Callable[[], bool]
    ) -> None:
        """Wait until the nodes have settled.

        Args:
            run_calls: runs the functions that nodes queued for the simulation.
            is_called: True if there are such functions.
            is_ending: True ends the wait.
        """
        due = time.monotonic() + _REST_S
        while not is_ending():
            run_calls()
            if self._loop.wait_idle(_TURN_S, unless=is_called) and not is_called():
                return
            if time.monotonic() > due:
                self._give_up()
                return

    def record_step(self, time_ns: int) -> None:
        """Record the messages up to a time [ns] at which the nodes have settled."""
        if self._recorder is not None:
            self._recorder.write(time_ns)
        is_over = self._settle is not None and self._settle()
        if is_over or (self._end_ns is not None and time_ns >= self._end_ns):
            self.over.set()

    def _give_up(self) -> None:
        self._loop.work.abandon()
        if self._say is not None:
            self._say(
                "a node does not settle while time is held; time goes on, but another run may differ from this one"
            )
            self._say = None
