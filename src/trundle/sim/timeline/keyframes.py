"""Timeline: states of the last minutes at intervals, and the commands between them.

A seek restores the last saved state before the moment, and simulates from there with the recorded commands.
Simulations repeat exactly, so the state is equal to the bit.
"""

import time
from bisect import bisect_right
from collections.abc import Callable, Sequence
from typing import TypeAlias

from msgspec import Struct

from trundle.base.diagnostics import UsageError
from trundle.sim.simulation import Simulation, StridePart
from trundle.spatial import NS_PER_S

from .inside import is_outside
from .saved_objects import SavedObjects

DEFAULT_LIMIT_BYTES = 256 * 1024 * 1024
_PERIOD_NS = NS_PER_S
"""Simulation time between two saved states [ns]; a seek simulates at most this."""
_MIN_WALL_RATIO = 20
"""Smallest wall time between two saved states, in multiples of the time that saving takes."""
Command: TypeAlias = Callable[[Simulation], object]


class _Keyframe(Struct, frozen=True, eq=False):
    time_ns: int
    objects: SavedObjects
    commands: int
    """Number of commands before this state, since the timeline began."""
    bytes: int


class _Recorded(Struct, frozen=True, eq=False):
    time_ns: int
    command: Command


class Timeline:
    """Saved states and commands of a simulation; used between its steps only, on its thread.

    After a `seek` the simulation repeats the recorded run, with its commands and messages from outside, until a new
    command arrives or the recorded end is reached. A reset of time begins a new timeline.
    """

    def __init__(
        self,
        simulation: Simulation,
        *,
        roots: Sequence[object] = (),
        limit_bytes: int = DEFAULT_LIMIT_BYTES,
        wall_ns: Callable[[], int] = time.monotonic_ns,
    ) -> None:
        """Begin at the current time.

        Args:
            simulation: running simulation.
            roots: objects with state that no hook of the simulation refers to, such as plugins that only subscribe.
            limit_bytes: approximate memory of the saved states; the oldest are dropped.
            wall_ns: wall clock [ns].
        """
        self._simulation = simulation
        self._roots = roots
        self._limit_bytes = limit_bytes
        self._wall_ns = wall_ns
        self._keyframes: list[_Keyframe] = []
        self._commands: list[_Recorded] = []
        self._dropped = 0
        """Number of commands before the first recorded one."""
        self._next = 0
        """Index of the next command to repeat."""
        self._end_ns = 0
        self._due_wall_ns = 0
        self._is_seeking = False
        simulation.inputs.record = self._record_input
        self._begin()

    @property
    def start_ns(self) -> int:
        """Earliest moment that can be reached [ns]."""
        return self._keyframes[0].time_ns

    @property
    def end_ns(self) -> int:
        """Latest moment that was simulated [ns]."""
        return max(self._end_ns, self._simulation.time_ns)

    @property
    def is_repeating(self) -> bool:
        """True while recorded commands remain to be repeated."""
        return self._next < len(self._commands)

    @property
    def lost(self) -> set[type]:
        """Types of objects whose progress cannot be saved; a repeated run may then differ."""
        return self._keyframes[-1].objects.lost

    def do(self, command: Command) -> None:
        """Run a command now and whenever this moment is repeated; later recorded commands are discarded."""
        self._discard_future()
        command(self._simulation)
        self._record(command)

    def _record_input(self, repeat: Callable[[], object]) -> None:
        """Record an input from outside, after its effect."""
        if not self._is_seeking:
            self._discard_future()
            self._record(lambda _: repeat())

    def _record(self, command: Command) -> None:
        self._commands.append(_Recorded(self._simulation.time_ns, command))
        self._next = len(self._commands)

    def advance(self, until_ns: int, simulate: Callable[[int], None] | None = None) -> None:
        """Simulate up to a time [ns], with the recorded commands on the way.

        Args:
            until_ns: time [ns].
            simulate: simulates up to a time; None: `Simulation.advance`.

        Raises:
            SimulationUnstableError: the physics became unstable; the world has its last good state.
        """
        simulation = self._simulation
        simulate = simulate or simulation.advance
        while self._next < len(self._commands) and (at_ns := self._commands[self._next].time_ns) <= until_ns:
            if at_ns > simulation.time_ns:
                simulate(at_ns)
            self._commands[self._next].command(simulation)
            self._next += 1
        if until_ns > simulation.time_ns:
            simulate(until_ns)
        self._save_if_due()

    def seek(self, time_ns: int) -> None:
        """Go to a moment, from `start_ns` to `end_ns`.

        Raises:
            UsageError: the moment is not part of the timeline.
        """
        if not self.start_ns <= time_ns <= self.end_ns:
            start, end = (f"{bound_ns / NS_PER_S:.3f}" for bound_ns in (self.start_ns, self.end_ns))
            raise UsageError(
                f"{time_ns / NS_PER_S:.3f} s is not part of the timeline, which is from {start} to {end} s"
            )
        self._end_ns = self.end_ns
        keyframe = self._keyframes[bisect_right(self._keyframes, time_ns, key=lambda frame: frame.time_ns) - 1]
        now_ns = self._simulation.time_ns
        if not keyframe.time_ns <= now_ns <= time_ns:
            keyframe.objects.restore()
            self._next = keyframe.commands - self._dropped
        self._is_seeking = True
        try:
            self.advance(time_ns)
        finally:
            self._is_seeking = False

    def restart(self, roots: Sequence[object]) -> None:
        """Begin again at the current time, after an object with state was added; `roots` as in the constructor."""
        self._roots = roots
        self._begin()

    def _begin(self) -> None:
        self._keyframes.clear()
        self._commands.clear()
        self._next = self._dropped = self._end_ns = 0
        self._zero_ns = _zero_ns(self._simulation)
        self._save()

    def _discard_future(self) -> None:
        now_ns = self._simulation.time_ns
        self._end_ns = 0
        del self._commands[self._next :]
        while self._keyframes[-1].time_ns > now_ns or self._keyframes[-1].commands > self._dropped + self._next:
            self._keyframes.pop()

    def _save_if_due(self) -> None:
        if _zero_ns(self._simulation) != self._zero_ns:
            self._begin()
        elif (
            self._simulation.time_ns >= self._keyframes[-1].time_ns + _PERIOD_NS
            and self._wall_ns() >= self._due_wall_ns
        ):
            self._save()

    def _save(self) -> None:
        simulation, started = self._simulation, self._wall_ns()
        objects = SavedObjects([simulation, *self._roots], is_outside=is_outside)
        size = objects.size + simulation.engine.checkpoint_bytes
        self._keyframes.append(_Keyframe(simulation.time_ns, objects, self._dropped + self._next, size))
        while len(self._keyframes) > 1 and sum(frame.bytes for frame in self._keyframes) > self._limit_bytes:
            del self._keyframes[0]
            before = self._keyframes[0].commands - self._dropped
            del self._commands[:before]
            self._dropped += before
            self._next -= before
        now = self._wall_ns()
        self._due_wall_ns = now + _MIN_WALL_RATIO * (now - started)
        if simulation.profiler is not None:
            simulation.profiler.lap(StridePart.TIMELINE)


def _zero_ns(simulation: Simulation) -> int:
    """Return the total simulated time at which the time was reset last [ns]."""
    return simulation.simulated_ns - simulation.time_ns
