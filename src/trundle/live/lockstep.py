"""Lockstep of a run: time advances only when this process's nodes have settled, so that runs repeat."""

import threading
import time
from collections.abc import Callable

from trundle.ros import GraphLoop, PendingWork, StepRecorder

_STARTING_PASSES = 50
"""Idle passes of the loop after which nodes that start count as settled; they may work between two calls."""
_ANSWER_S = 10.0
"""Silence [s] after which a missing answer is assumed to need ROS time, as that of a service that sleeps."""
_ANSWER_PASSES = 1000
"""Minimum passes of the loop in this silence; a suspended process makes none."""


class Lockstep:
    """Holds time at zero while a launch starts, at each step until the nodes have settled, and at the end.

    It waits for this process's own work without a time limit; `GraphLoop` prints what it waits for.
    """

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
            end_ns: end of the run [ns]; None: unlimited.
            recorder: writes the messages of each step.
            say: prints which answers did not arrive while time was held.
            settle: called at each time at which the nodes have settled; True ends the run.
        """
        self._settle = settle
        self._loop = loop
        self._end_ns = end_ns
        self._recorder = recorder
        self._say: Callable[[str], None] | None = say
        self._has_begun = threading.Event()
        self.over = threading.Event()
        """Set when the end is reached and recorded."""

    async def wait_started(self, is_ending: Callable[[], bool]) -> None:
        """Wait, on the loop, until the nodes started so far have settled.

        Args:
            is_ending: True ends the wait.
        """
        silence = _Silence(self._loop.work)
        while not is_ending():
            if await self._loop.idle(unless=lambda: is_ending() or silence.is_over(), passes=_STARTING_PASSES):
                return
            self._check(silence)

    def start(self) -> None:
        """Let time advance."""
        self._has_begun.set()

    @property
    def is_ready(self) -> bool:
        """True if time may advance now."""
        return self._has_begun.is_set() and not self.over.is_set()

    def hold(self) -> None:
        """Hold time at zero again, while nodes restart."""
        self._has_begun.clear()
        self.over.clear()

    def rewind(self) -> None:
        """Let time advance again after the end, to the same end."""
        self.over.clear()

    def target_ns(self, time_ns: int) -> int:
        """Clamp a target time [ns] to the end of the run."""
        return time_ns if self._end_ns is None else min(time_ns, self._end_ns)

    def wait_settled(
        self, run_calls: Callable[[], None], is_called: Callable[[], bool], is_ending: Callable[[], bool]
    ) -> None:
        """Wait until the nodes have settled.

        Args:
            run_calls: runs the functions that nodes queued for the simulation.
            is_called: True if functions are queued.
            is_ending: True ends the wait.
        """
        silence = _Silence(self._loop.work)
        while not is_ending():
            run_calls()
            if self._loop.wait_idle(unless=lambda: is_called() or silence.is_over()) and not is_called():
                return
            self._check(silence)

    def record_step(self, time_ns: int) -> None:
        """Record the messages up to a time [ns] at which the nodes have settled."""
        if self._recorder is not None:
            self._recorder.write(time_ns)
        is_over = self._settle is not None and self._settle()
        if is_over or (self._end_ns is not None and time_ns >= self._end_ns):
            self.over.set()

    def _check(self, silence: "_Silence") -> None:
        """Stop waiting for answers that need time to pass."""
        if not silence.is_over():
            return
        names = self._loop.work.abandon_answers()
        if self._say is not None:
            self._say(
                f"{', '.join(names)} does not arrive while time is held; time advances, "
                "but another run may differ from this one"
            )
            self._say = None


class _Silence:
    """Timer of a wait in which only answers are missing and none arrives; polled at each pass of the loop."""

    def __init__(self, work: PendingWork) -> None:
        self._work = work
        self._begin()

    def _begin(self) -> None:
        self._seen_changes = self._work.changes
        self._start_s = time.monotonic()
        self._passes = 0

    def is_over(self) -> bool:
        """True after a sufficient number of passes and seconds."""
        if self._seen_changes != self._work.changes or not self._work.awaits_only_answers:
            self._begin()
            return False
        self._passes += 1
        return self._passes >= _ANSWER_PASSES and time.monotonic() >= self._start_s + _ANSWER_S
