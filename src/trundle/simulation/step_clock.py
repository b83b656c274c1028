"""Which step ends when; the time step may be another one from some step on."""

from fractions import Fraction
from typing import TypeAlias

from msgspec import Struct

from trundle.model import World
from trundle.spatial import NS_PER_S

Period: TypeAlias = int | Fraction
"""[ns]"""


def world_step_ns(world: World) -> int:
    """How long a step is that a world asks for [ns]."""
    return round(world.physics.max_step_size_s * NS_PER_S)


class StepClock(Struct, frozen=True):
    """Steps of one length, counted from a step at which time was known."""

    step_ns: int
    first_step: int = 0
    first_ns: int = 0

    def time_ns(self, step: int) -> int:
        """The time at a step."""
        return self.first_ns + (step - self.first_step) * self.step_ns

    def step_at(self, time_ns: Period) -> int:
        """The first step that reaches a time."""
        return self.first_step - ((self.first_ns - time_ns) // self.step_ns)

    def with_step(self, step_ns: int, *, since: int) -> "StepClock":
        """One that is as this up to a step, and has others from there on; this one where they are no others."""
        return self if step_ns == self.step_ns else StepClock(step_ns, since, self.time_ns(since))
