"""Wrenches and efforts with start time and duration."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, TypeVar

from trundle.sim.simulation import JointHandle, LinkHandle, Simulation

Target = TypeVar("Target", LinkHandle, JointHandle)
Load = TypeVar("Load")


@dataclass(frozen=True, slots=True)
class _ScheduledLoad(Generic[Target, Load]):
    target: Target
    load: Load
    start_ns: int
    end_ns: int | None
    """Time of the end [ns]; None: unlimited."""


class TimedLoads(Generic[Target, Load]):
    """Timed loads on links or joints; a simulation hook that is active only until every load has ended."""

    def __init__(self, simulation: Simulation, apply: Callable[[Target, list[Load]], None]) -> None:
        """Create; call `start` first.

        Args:
            simulation: clock of the loads.
            apply: called with a target and its active loads, oldest first.
        """
        self._simulation = simulation
        self._apply = apply
        self._jobs: list[_ScheduledLoad[Target, Load]] = []
        self._active_loads: dict[Target, list[Load]] = {}
        self._next_ns: int | None = None
        """Next time at which a load begins or ends [ns]."""

    def start(self) -> None:
        """Register the hook."""
        self._simulation.add_hook(self, enabled=lambda: self._next_ns is not None)
        self._simulation.on_reset(self._on_reset)

    def add(self, target: Target, load: Load, *, start_ns: int, duration_ns: int) -> None:
        """Schedule a load, at the earliest now, for at least one step; a negative duration means unlimited."""
        start_ns = max(start_ns, self._simulation.time_ns)
        end_ns = None if duration_ns < 0 else start_ns + max(duration_ns, self._simulation.step_ns)
        self._jobs.append(_ScheduledLoad(target, load, start_ns, end_ns))
        self._reschedule()

    def clear(self, target: Target) -> None:
        """Remove the loads of a target."""
        self._jobs = [job for job in self._jobs if job.target is not target]
        self._reschedule()

    def before_step(self, simulation: Simulation) -> None:
        """Begin and end the loads that are due."""
        if self._next_ns is not None and simulation.time_ns >= self._next_ns:
            self._reschedule()

    def _reschedule(self) -> None:
        now = self._simulation.time_ns
        self._jobs = [job for job in self._jobs if job.target.is_valid and (job.end_ns is None or job.end_ns > now)]
        active_loads: dict[Target, list[Load]] = {}
        for job in self._jobs:
            if job.start_ns <= now:
                active_loads.setdefault(job.target, []).append(job.load)
        for target in {**self._active_loads, **active_loads}:
            loads = active_loads.get(target, [])
            if target.is_valid and loads != self._active_loads.get(target, []):
                self._apply(target, loads)
        self._active_loads = active_loads
        times = [time for job in self._jobs for time in (job.start_ns, job.end_ns) if time is not None and time > now]
        self._next_ns = min(times, default=None)

    def _on_reset(self) -> None:
        """Drop all loads: a reset clears applied forces."""
        self._jobs.clear()
        self._active_loads.clear()
        self._next_ns = None
