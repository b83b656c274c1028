"""Periodic hooks.

A hook is any object with `before_step(simulation)`, `after_step(snapshot)` or both. It is due at multiples of its
period; between due times the engine runs in C. At one instant every due `after_step` reads the world, then every due
`before_step` acts on it; each in the order of registration. Hooks that share work also have a `prepare(snapshot)`,
which is called on all due hooks before the first `after_step`. A method with a true attribute `does_nothing`, such as
an empty default of a base class, is never due.
"""

from collections.abc import Callable
from typing import TYPE_CHECKING, Generic, Protocol, TypeVar, runtime_checkable

from .snapshot import Snapshot
from .step_clock import Period, StepClock

if TYPE_CHECKING:
    from trundle.sim.physics import StepAction


_NEVER_NS = 2**62


class SteppedWorld(Protocol):
    """World that hooks act on."""

    steps: int
    """Number of steps made."""


WorldT = TypeVar("WorldT", bound=SteppedWorld)
_WorldT = TypeVar("_WorldT", contravariant=True)


class BeforeStep(Protocol[_WorldT]):
    """Hook that acts on the world."""

    def before_step(self, sim: _WorldT, /) -> None:
        """Write efforts, velocities and wrenches."""
        ...


@runtime_checkable
class InStep(Protocol):
    """Hook that acts in C++ within a stride, if it is due at every step."""

    def step_action(self) -> "tuple[StepAction, float] | None":
        """Return the action from the second step of a stride on, and the time at which `before_step` is due again [ns],
        or infinity; None: at every step. Called after each `before_step`.
        """
        ...

    def finish_stride(self) -> None:
        """Continue after the steps of a stride; the action may have ended it early."""
        ...


class AfterStep(Protocol):
    """Hook that observes the world."""

    def after_step(self, snapshot: Snapshot, /) -> None:
        """Read the snapshot; never write."""
        ...


def _method(hook: object, name: str) -> Callable[..., None] | None:
    method = getattr(hook, name, None)
    return None if getattr(method, "does_nothing", False) else method


class PeriodicTimer:
    """Timer due at multiples of a period from a start: never early, and late by less than a step.

    A period that is not a whole number of nanoseconds is a fraction, so that no error accumulates.
    """

    def __init__(self, period_ns: Period, clock: StepClock, *, start_ns: Period) -> None:
        self._period_ns = period_ns
        self.restart(start_ns, clock)

    @property
    def at_every_step(self) -> bool:
        """True if the timer is due at every step."""
        return self._at_every_step

    def restart(self, start_ns: Period, clock: StepClock | None = None) -> None:
        """Set the next due time [ns], optionally for another clock."""
        if clock is not None:
            self._clock = clock
            self._at_every_step = self._period_ns <= clock.step_ns
        self._next_ns = start_ns
        self.step = self._clock.step_at(start_ns)
        """Step at which the timer is due."""

    def set_clock(self, clock: StepClock) -> None:
        """Keep the due time after a change of clock."""
        self.restart(self._clock.time_ns(self.step) if self._at_every_step else self._next_ns, clock)

    def due(self, step: int) -> bool:
        """True if the timer is due; it then advances to its next time."""
        if step < self.step:
            return False
        if self._at_every_step:
            self.step = step + 1
            return True
        late_ns = self._clock.time_ns(step) - self._next_ns
        self.restart(self._next_ns + (late_ns // self._period_ns + 1) * self._period_ns)
        return True


class ScheduledHook(Generic[WorldT]):
    """Hook with its timers: `before_step` is first due at once, `after_step` after one period."""

    def __init__(
        self,
        hook: object,
        period_ns: Period,
        clock: StepClock,
        *,
        now_ns: int,
        enabled: Callable[[], bool] | None,
        name: str | None,
    ) -> None:
        self.hook = hook
        self.name = name
        self.enabled = enabled
        self.was_enabled = True
        """Value of `enabled` at the last check."""
        self.before: Callable[[WorldT], None] | None = _method(hook, "before_step")
        self.after: Callable[[Snapshot], None] | None = _method(hook, "after_step")
        self.prepare: Callable[[Snapshot], None] | None = getattr(hook, "prepare", None)
        has_method = hasattr(hook, "before_step") or hasattr(hook, "after_step")
        assert has_method, f"{hook!r} has neither before_step nor after_step"
        self._in_step = hook if isinstance(hook, InStep) else None
        self.action: StepAction | None = None
        """Action of the coming steps except the first; None: `before_step` only."""
        self._until_ns = 0
        self._clock = clock
        self.retime(period_ns, now_ns=now_ns)

    def retime(self, period_ns: Period, *, now_ns: int) -> None:
        """Start a new period now."""
        # Whole nanoseconds, the usual case, stay integers: fractions cost ten times as much.
        self._requested_ns = period_ns = int(period_ns) if period_ns.denominator == 1 else period_ns
        self.before_timer = PeriodicTimer(period_ns, self._clock, start_ns=now_ns)
        self.after_timer = PeriodicTimer(period_ns, self._clock, start_ns=now_ns + self._period_ns)
        alarms = ((self.before, self.before_timer), (self.after, self.after_timer))
        self._timers = [alarm for method, alarm in alarms if method is not None]

    def set_clock(self, clock: StepClock) -> None:
        """Keep the due times after a change of clock."""
        self._clock = clock
        self.before_timer.set_clock(clock)
        self.after_timer.set_clock(clock)

    def restart(self, step: int) -> None:
        """Restart the timers at a step, after a reset or restore."""
        now_ns, period_ns = self._clock.time_ns(step), self._period_ns
        self.before_timer.restart(-(-now_ns // period_ns) * period_ns)
        self.after_timer.restart((now_ns // period_ns + 1) * period_ns)

    def update_enabled(self, step: int) -> bool:
        """Return the value of `enabled`; a hook that becomes enabled restarts at this step."""
        if self.enabled is None:
            return True
        before, self.was_enabled = self.was_enabled, self.enabled()
        if self.was_enabled and not before:
            self.restart(step)
        return self.was_enabled

    @property
    def _period_ns(self) -> Period:
        return max(self._requested_ns, self._clock.step_ns)

    def find_action(self) -> "StepAction | None":
        """Return the action in C++ of the coming stride; `next_step` then concerns Python only."""
        self.action = None
        if self._in_step is not None and self.before_timer.at_every_step:
            step_action = self._in_step.step_action()
            if step_action is not None:
                self.action, self._until_ns = step_action[0], int(min(max(step_action[1], 0), _NEVER_NS))
        return self.action

    def finish_stride(self) -> None:
        """Finish the stride of a hook that acted in C++."""
        if self.action is not None and self._in_step is not None:
            self._in_step.finish_stride()

    @property
    def next_step(self) -> int:
        """Next step at which the engine has to stop for the hook."""
        if self.action is None:
            return min([alarm.step for alarm in self._timers])
        steps = [alarm.step for alarm in self._timers if alarm is not self.before_timer]
        return min([max(self._clock.step_at(self._until_ns), self.before_timer.step), *steps])
