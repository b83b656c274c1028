"""Who is called as simulation time passes.

A hook is any object with `before_step(simulation)`, `after_step(snapshot)` or both. It is due at multiples of its
period; between two due times the engine runs in C. At one instant the order is: every `after_step` that is due sees
the world, then every `before_step` that is due acts on it; each in the order the hooks were added.
"""

from collections.abc import Callable
from fractions import Fraction
from typing import TYPE_CHECKING, Protocol, TypeAlias

from .snapshot import Snapshot

if TYPE_CHECKING:
    from .simulation import Simulation

Period: TypeAlias = int | Fraction
"""[ns]"""


class BeforeStep(Protocol):
    """Acts on the world."""

    def before_step(self, sim: "Simulation", /) -> None:
        """Write efforts, speeds and wrenches."""
        ...


class AfterStep(Protocol):
    """Looks at the world."""

    def after_step(self, snapshot: Snapshot, /) -> None:
        """Read, never write."""
        ...


class Alarm:
    """Comes due at multiples of a period, counted from a start: never early, and late by less than a step.

    A period that is no whole number of nanoseconds is a fraction: nothing adds up, however long it runs.
    """

    def __init__(self, period_ns: Period, step_ns: int, *, start_ns: Period) -> None:
        self._period_ns = max(period_ns, step_ns)
        self._step_ns = step_ns
        self.restart(start_ns)

    def restart(self, start_ns: Period) -> None:
        """Come due first at this time [ns]."""
        self._next_ns = start_ns
        self.step = -(-start_ns // self._step_ns)
        """The number of the step it is due at."""

    def rings(self, step: int) -> bool:
        """Whether it is due; if so, it is set to its next time."""
        if step < self.step:
            return False
        late_ns = step * self._step_ns - self._next_ns
        self.restart(self._next_ns + (late_ns // self._period_ns + 1) * self._period_ns)
        return True


class ScheduledHook:
    """A hook and its alarms: it acts at once and then every period, and looks after the first period."""

    def __init__(
        self, hook: object, period_ns: Period, step_ns: int, *, now_ns: int, wanted: Callable[[], bool] | None
    ) -> None:
        self.hook = hook
        self.wanted = wanted
        self.awake = True
        """Whether it was wanted at the last look."""
        self.before: Callable[[Simulation], None] | None = getattr(hook, "before_step", None)
        self.after: Callable[[Snapshot], None] | None = getattr(hook, "after_step", None)
        assert self.before or self.after, f"{hook!r} has neither before_step nor after_step"
        self.retime(period_ns, step_ns, now_ns=now_ns)

    def retime(self, period_ns: Period, step_ns: int, *, now_ns: int) -> None:
        """Count a period from now."""
        self._period_ns = max(period_ns, step_ns)
        self.before_alarm = Alarm(period_ns, step_ns, start_ns=now_ns)
        self.after_alarm = Alarm(period_ns, step_ns, start_ns=now_ns + self._period_ns)

    def restart(self, step: int, step_ns: int) -> None:
        """Count time anew from a step that is a reset's or a restored state's."""
        now_ns = step * step_ns
        self.before_alarm.restart(-(-now_ns // self._period_ns) * self._period_ns)
        self.after_alarm.restart((now_ns // self._period_ns + 1) * self._period_ns)

    def wakes(self, step: int, step_ns: int) -> bool:
        """Whether it is to be called at all; one that was not wanted for a while starts anew from this step."""
        if self.wanted is None:
            return True
        was_awake, self.awake = self.awake, self.wanted()
        if self.awake and not was_awake:
            self.restart(step, step_ns)
        return self.awake

    @property
    def next_step(self) -> int:
        """The step before which the engine has to stop for it."""
        alarms = [(self.before, self.before_alarm), (self.after, self.after_alarm)]
        return min(alarm.step for method, alarm in alarms if method is not None)
