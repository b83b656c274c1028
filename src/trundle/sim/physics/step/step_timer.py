"""Timers of the parts of MuJoCo's step; they read the clock some thirty times, so few steps are timed."""

import mujoco
from msgspec import Struct

from .. import _contact_laws

_TIMER = mujoco.mjtTimer
_COLLISION = (_TIMER.mjTIMER_POS_COLLISION,)
_CONSTRAINTS = (_TIMER.mjTIMER_POS_MAKE, _TIMER.mjTIMER_POS_PROJECT, _TIMER.mjTIMER_CONSTRAINT)


class StepTimes(Struct, frozen=True):
    """Wall times of timed steps."""

    collision_s: float
    """Detection of contacts."""
    constraints_s: float
    """Constraints of contacts, limits and motors: making and solving them."""
    total_s: float


class StepTimer:
    """Timer of the steps of one engine, off at first."""

    def __init__(self, data: mujoco.MjData) -> None:
        timers = data.timer
        kinds = (_COLLISION, _CONSTRAINTS, (_TIMER.mjTIMER_STEP,))
        self._groups = [[timers[kind] for kind in group] for group in kinds]
        self._before = self._read()

    def start(self) -> None:
        """Time the steps from now on."""
        self._before = self._read()
        _contact_laws.set_timers(True)

    def stop(self) -> StepTimes:
        """Stop timing; return the times since `start`, zero where the engine was reset meanwhile."""
        _contact_laws.set_timers(False)
        times = [max(0.0, now - before) for now, before in zip(self._read(), self._before, strict=True)]
        return StepTimes(*times)

    def _read(self) -> list[float]:
        return [sum(timer.duration for timer in group) for group in self._groups]
