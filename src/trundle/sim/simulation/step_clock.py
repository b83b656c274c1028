"""Conversion between steps and simulation time; the step length may change at a step."""

from fractions import Fraction
from typing import TypeAlias

from msgspec import Struct

from trundle.robots.model import World
from trundle.spatial import NS_PER_S

Period: TypeAlias = int | Fraction
"""[ns]"""


def world_step_ns(world: World) -> int:
    """Return a world's step length [ns]."""
    return round(world.physics.max_step_size_s * NS_PER_S)


class StepClock(Struct, frozen=True):
    """Steps of one length, counted from a step of known time."""

    step_ns: int
    first_step: int = 0
    first_ns: int = 0

    def time_ns(self, step: int) -> int:
        """Return the time at a step."""
        return self.first_ns + (step - self.first_step) * self.step_ns

    def step_at(self, time_ns: Period) -> int:
        """Return the first step at or after a time."""
        return self.first_step - ((self.first_ns - time_ns) // self.step_ns)

    def with_step(self, step_ns: int, *, since: int) -> "StepClock":
        """Return a clock that equals this one up to a step and has another step length from there on."""
        return self if step_ns == self.step_ns else StepClock(step_ns, since, self.time_ns(since))
