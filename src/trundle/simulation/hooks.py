"""Who is called as simulation time passes.

A hook is any object with `before_step(simulation)`, `after_step(snapshot)` or both. It is due at multiples of its
period; between two due times the engine runs in C. At one instant the order is: every `after_step` that is due sees
the world, then every `before_step` that is due acts on it; each in the order the hooks were added. Hooks that share
work have a `prepare(snapshot)`, too, which is called of all that are due before any of them sees the world.
"""

from collections.abc import Callable
from typing import TYPE_CHECKING, Protocol

from .snapshot import Snapshot
from .step_clock import Period, StepClock

if TYPE_CHECKING:
    from .simulation import Simulation


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


class PeriodicTimer:
    """Comes due at multiples of a period, counted from a start: never early, and late by less than a step.

    A period that is no whole number of nanoseconds is a fraction: nothing adds up, however long it runs.
    """

    def __init__(self, period_ns: Period, clock: StepClock, *, start_ns: Period) -> None:
        self._period_ns = period_ns
        self.restart(start_ns, clock)

    def restart(self, start_ns: Period, clock: StepClock | None = None) -> None:
        """Come due first at this time [ns], at the steps of a timeline, or of the same as before."""
        if clock is not None:
            self._clock = clock
            self._at_every_step = self._period_ns <= clock.step_ns
        self._next_ns = start_ns
        self.step = self._clock.step_at(start_ns)
        """The number of the step it is due at."""

    def set_clock(self, clock: StepClock) -> None:
        """Come due when it would have, at the steps of another timeline."""
        self.restart(self._clock.time_ns(self.step) if self._at_every_step else self._next_ns, clock)

    def due(self, step: int) -> bool:
        """Whether it is due; if so, it is set to its next time."""
        if step < self.step:
            return False
        if self._at_every_step:
            self.step = step + 1
            return True
        late_ns = self._clock.time_ns(step) - self._next_ns
        self.restart(self._next_ns + (late_ns // self._period_ns + 1) * self._period_ns)
        return True


class ScheduledHook:
    """A hook and its alarms: it acts at once and then every period, and looks after the first period."""

    def __init__(
        self, hook: object, period_ns: Period, clock: StepClock, *, now_ns: int, enabled: Callable[[], bool] | None
    ) -> None:
        self.hook = hook
        self.enabled = enabled
        self.was_enabled = True
        """Whether it was wanted at the last look."""
        self.before: Callable[[Simulation], None] | None = getattr(hook, "before_step", None)
        self.after: Callable[[Snapshot], None] | None = getattr(hook, "after_step", None)
        self.prepare: Callable[[Snapshot], None] | None = getattr(hook, "prepare", None)
        assert self.before or self.after, f"{hook!r} has neither before_step nor after_step"
        self._clock = clock
        self.retime(period_ns, now_ns=now_ns)

    def retime(self, period_ns: Period, *, now_ns: int) -> None:
        """Count a period from now."""
        # Whole numbers of nanoseconds, as most periods are, are kept as such: fractions cost ten times as much.
        self._asked_ns = period_ns = int(period_ns) if period_ns.denominator == 1 else period_ns
        self.before_timer = PeriodicTimer(period_ns, self._clock, start_ns=now_ns)
        self.after_timer = PeriodicTimer(period_ns, self._clock, start_ns=now_ns + self._period_ns)
        alarms = ((self.before, self.before_timer), (self.after, self.after_timer))
        self._timers = [alarm for method, alarm in alarms if method is not None]

    def set_clock(self, clock: StepClock) -> None:
        """Keep the rhythm at other steps."""
        self._clock = clock
        self.before_timer.set_clock(clock)
        self.after_timer.set_clock(clock)

    def restart(self, step: int) -> None:
        """Count time anew from a step that is a reset's or a restored state's."""
        now_ns, period_ns = self._clock.time_ns(step), self._period_ns
        self.before_timer.restart(-(-now_ns // period_ns) * period_ns)
        self.after_timer.restart((now_ns // period_ns + 1) * period_ns)

    def update_enabled(self, step: int) -> bool:
        """Whether it is to be called at all; one that was not wanted for a while starts anew from this step."""
        if self.enabled is None:
            return True
        was_awake, self.was_enabled = self.was_enabled, self.enabled()
        if self.was_enabled and not was_awake:
            self.restart(step)
        return self.was_enabled

    @property
    def _period_ns(self) -> Period:
        return max(self._asked_ns, self._clock.step_ns)

    @property
    def next_step(self) -> int:
        """The step before which the engine has to stop for it."""
        return min([alarm.step for alarm in self._timers])
