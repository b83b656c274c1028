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

_PATIENCE_NS = 1_000_000_000
"""Wall time from the last request to carry or pull a model until it is let go [ns]."""
_STEPS_AT_ONCE = 100
"""Steps between two looks at the requests."""


class Recorder(Protocol):
    """Recording that the page begins and ends."""

    @property
    def since_ns(self) -> int | None:
        """Simulation time at its begin; None: nothing is recorded."""
        ...

    def set(self, on: bool) -> None:
        """Begin or end it."""
        ...

    def follow(self) -> None:
        """Go on after the simulation went to another moment."""
        ...


class SimulationControls:
    """State of the controls: paused or not, and the steps that are still to do."""

    def __init__(
        self, world: ShownWorld, recorder: Recorder | None, *, wall_ns: Callable[[], int] = time.monotonic_ns
    ) -> None:
        """Prepare.

        Args:
            world: the running one.
            recorder: None: it cannot be recorded.
            wall_ns: the wall clock [ns].
        """
        self._wall_ns = wall_ns
        self._handled_ns: dict[str, int] = {}
        """Model that is carried or pulled → wall time of the last request to [ns]."""
        self._world, self._simulation = world, world.simulation
        self.recorder = recorder
        self._steps = 0

    def handle(self, action: PageAction, pacer: RealtimePacer, *, paused: bool) -> bool:
        """Do what a person asks for; return True if the simulation is paused now.

        Raises:
            TrundleError: it cannot be done; the message says why.
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
                    self._handled_ns[find_model(self._simulation, action.model).name] = self._wall_ns()
            case Seek(time_ns) if self._world.timeline is not None:
                paused, self._steps = True, 0
                self._world.timeline.seek(time_ns)
                if self.recorder is not None:
                    self.recorder.follow()
                pacer.restart()
            case Record(on) if self.recorder is not None:
                self.recorder.set(on)
            case Reload():
                raise UsageError("this world is loaded once: end what started it and start it again")
            case _:
                raise UsageError("this simulation does not do that")
        return paused

    def _steps_to(self, time_ns: int) -> int:
        """Return the steps up to a time.

        Raises:
            UsageError: it is not ahead, or too far.
        """
        simulation = self._simulation
        now_ns, step_ns = simulation.time_ns, simulation.step_ns
        steps = -((now_ns - time_ns) // step_ns)
        if not 0 < steps <= MAX_STEPS:
            last_ns = now_ns + MAX_STEPS * step_ns
            low, high = (f"{each / NS_PER_S:.3f} s" for each in (now_ns, last_ns))
            raise UsageError(f"{time_ns / NS_PER_S:.3f} s is not ahead: choose a time after {low}, up to {high}")
        return steps

    def step(self, pacer: RealtimePacer) -> bool:
        """Do some of the steps asked for; return True if any was done."""
        count = min(self._steps, _STEPS_AT_ONCE)
        if count:
            self._steps -= count
            self._world.advance(self._simulation.time_ns + count * self._simulation.step_ns)
            pacer.restart()
        return count > 0

    def let_lapsed_go(self) -> None:
        """Let models go whose person has fallen silent, such as one whose connection is lost."""
        if self._world.timeline is not None and self._world.timeline.is_repeating:
            return
        since_ns = self._wall_ns() - _PATIENCE_NS
        for model in handled_models(self._simulation):
            if self._handled_ns.get(model, since_ns) <= since_ns:
                self._world.do(partial(edit, LetGo(model)))


def reason_of(error: TrundleError) -> str:
    """Return a failure as the sentence of a response."""
    return " ".join(str(error).split())
