"""Requests of the page to a running simulation: time, joints and recording."""

import time
from collections.abc import Callable
from functools import partial
from typing import Protocol

from trundle.base.diagnostics import TrundleError, UsageError
from trundle.page import (
    MAX_STEPS,
    Carry,
    EditAction,
    LetGo,
    PageAction,
    Pause,
    Play,
    Pull,
    Record,
    Reload,
    Reset,
    RunTo,
    Seek,
    SetSpeed,
    Step,
)
from trundle.sim.realtime_pacer import RealtimePacer
from trundle.spatial import NS_PER_S

from ..shown_world import ShownWorld
from .edits import edit, find_model
from .handling import handled_models

_HANDLING_TIMEOUT_NS = 1_000_000_000
"""Wall time after the last request to carry or pull a model at which it is let go [ns]."""
_MAX_STEPS_PER_CALL = 100
"""Steps between two polls of the requests."""


class Recorder(Protocol):
    """Recording that the page starts and stops."""

    @property
    def since_ns(self) -> int | None:
        """Simulation time at its start; None: nothing is being recorded."""
        ...

    def set(self, on: bool) -> None:
        """Start or stop it."""
        ...

    def follow(self) -> None:
        """Continue after the simulation's time was set."""
        ...


class SimulationControls:
    """Executes control requests, and the steps that they ask for."""

    def __init__(
        self, world: ShownWorld, recorder: Recorder | None, *, wall_ns: Callable[[], int] = time.monotonic_ns
    ) -> None:
        """Create it.

        Args:
            world: running world.
            recorder: None: the run cannot be recorded.
            wall_ns: the wall clock [ns].
        """
        self._wall_ns = wall_ns
        self._last_handled_ns: dict[str, int] = {}
        """Model that is carried or pulled → wall time of the last request to do so [ns]."""
        self._world, self._simulation = world, world.simulation
        self.recorder = recorder
        self._steps = 0

    def handle(self, action: PageAction, pacer: RealtimePacer, *, paused: bool) -> bool:
        """Execute a request; return True if the simulation is paused afterwards.

        Raises:
            TrundleError: the request cannot be executed.
        """
        match action:
            case Play():
                paused, self._steps = False, 0
                pacer.restart()
            case Pause():
                paused, self._steps = True, 0
            case Step(count):
                paused, self._steps = True, self._steps + count
            case RunTo(time_ns):
                paused, self._steps = True, self._steps_to(time_ns)
            case Reset(what):
                self._world.do(lambda sim: sim.reset(time=what != "poses", poses=what != "time"))
                pacer.restart()
            case SetSpeed(factor):
                pacer.set_speed(factor)
            case _ if isinstance(action, EditAction):
                self._world.do(partial(edit, action))
                if isinstance(action, Carry | Pull):
                    self._last_handled_ns[find_model(self._simulation, action.model).name] = self._wall_ns()
            case Seek(time_ns) if self._world.timeline is not None:
                paused, self._steps = True, 0
                self._world.timeline.seek(time_ns)
                if self.recorder is not None:
                    self.recorder.follow()
                pacer.restart()
            case Record(on) if self.recorder is not None:
                self.recorder.set(on)
            case Reload():
                raise UsageError("this world cannot be reloaded: stop its process and start it again")
            case _:
                raise UsageError("this simulation does not support this request")
        return paused

    def _steps_to(self, time_ns: int) -> int:
        """Return the number of steps to a time.

        Raises:
            UsageError: the time is not in the future, or more than `MAX_STEPS` ahead.
        """
        simulation = self._simulation
        now_ns, step_ns = simulation.time_ns, simulation.step_ns
        steps = -((now_ns - time_ns) // step_ns)
        if not 0 < steps <= MAX_STEPS:
            last_ns = now_ns + MAX_STEPS * step_ns
            low, high = (f"{bound_ns / NS_PER_S:.3f} s" for bound_ns in (now_ns, last_ns))
            raise UsageError(f"{time_ns / NS_PER_S:.3f} s is not ahead: choose a time after {low}, up to {high}")
        return steps

    def step(self, pacer: RealtimePacer) -> bool:
        """Do some of the requested steps; return True if there were any."""
        count = min(self._steps, _MAX_STEPS_PER_CALL)
        if count:
            self._steps -= count
            self._world.advance(self._simulation.time_ns + count * self._simulation.step_ns)
            pacer.restart()
        return count > 0

    def let_go_after_timeout(self) -> None:
        """Let go of models without a request to carry or pull them for a second, as after a lost connection."""
        if self._world.timeline is not None and self._world.timeline.is_repeating:
            return
        since_ns = self._wall_ns() - _HANDLING_TIMEOUT_NS
        for model in handled_models(self._simulation):
            if self._last_handled_ns.get(model, since_ns) <= since_ns:
                self._world.do(partial(edit, LetGo(model)))


def reason_of(error: TrundleError) -> str:
    """Return an error's message as one line, for a response."""
    return " ".join(str(error).split())
