"""Schedule: the hooks of one simulation."""

from collections.abc import Callable
from typing import TYPE_CHECKING, Generic

from .hooks import AfterStep, BeforeStep, ScheduledHook, WorldT
from .profiler import Profiler, StridePart
from .snapshot import Snapshot
from .step_clock import Period, StepClock

if TYPE_CHECKING:
    from trundle.sim.physics import StepAction


class Schedule(Generic[WorldT]):
    """Hooks in order of registration."""

    def __init__(self, clock: StepClock) -> None:
        self._clock = clock
        self._hooks: list[ScheduledHook[WorldT]] = []

    def add(
        self,
        hook: BeforeStep[WorldT] | AfterStep,
        period_ns: Period,
        *,
        now_ns: int,
        enabled: Callable[[], bool] | None,
        name: str | None,
    ) -> None:
        """Register a hook from now [ns] on; see `Simulation.add_hook`."""
        scheduled = ScheduledHook[WorldT](hook, period_ns, self._clock, now_ns=now_ns, enabled=enabled, name=name)
        if scheduled.before is not None or scheduled.after is not None:
            self._hooks.append(scheduled)

    def retime(self, hook: object, period_ns: Period, *, now_ns: int) -> None:
        """Change a hook's period [ns] from now [ns] on; the order of hooks stays."""
        for scheduled in self._hooks:
            if scheduled.hook is hook:
                scheduled.retime(period_ns, now_ns=now_ns)

    @property
    def hooks(self) -> list[object]:
        """Hooks in order of registration."""
        return [scheduled.hook for scheduled in self._hooks]

    def name_of(self, hook: object) -> str | None:
        """Return the name that a hook was registered with."""
        return next((scheduled.name for scheduled in self._hooks if scheduled.hook is hook), None)

    def rename_model(self, name: str, new: str) -> None:
        """Rename the hooks named `model::…` after a model was renamed."""
        for hook in self._hooks:
            if hook.name is not None and hook.name.startswith(f"{name}::"):
                hook.name = new + hook.name.removeprefix(name)

    def remove(self, hook: object) -> None:
        """Remove a hook."""
        self._hooks = [scheduled for scheduled in self._hooks if scheduled.hook is not hook]

    def set_clock(self, clock: StepClock) -> None:
        """Keep the due times of all hooks after a change of clock."""
        self._clock = clock
        for hook in self._hooks:
            hook.set_clock(clock)

    def restart(self, step: int) -> None:
        """Restart all hooks at a step, after a reset or restore."""
        for hook in self._hooks:
            hook.restart(step)

    def enabled(self, step: int) -> list[ScheduledHook[WorldT]]:
        """Return the enabled hooks of the stride that begins with this step."""
        return [hook for hook in self._hooks if hook.update_enabled(step)]


def run_before(hooks: list[ScheduledHook[WorldT]], sim: WorldT, profiler: Profiler | None) -> None:
    """Call `before_step` of the hooks that are due."""
    for hook in hooks:
        if hook.before is not None and hook.before_timer.due(sim.steps):
            hook.before(sim)
            if profiler is not None:
                profiler.lap(hook.hook)


def find_actions(hooks: list[ScheduledHook[WorldT]]) -> "list[StepAction]":
    """Return the actions in C++ of the coming stride, in order."""
    return [action for hook in hooks if (action := hook.find_action()) is not None]


def finish_stride(hooks: list[ScheduledHook[WorldT]]) -> None:
    """Finish the stride of the hooks that acted in C++."""
    for hook in hooks:
        hook.finish_stride()


def run_after(
    hooks: list[ScheduledHook[WorldT]], step: int, snapshot: Callable[[], Snapshot], profiler: Profiler | None
) -> None:
    """Call `after_step` of the hooks that are due; the snapshot is taken only if there are any."""
    due = [hook for hook in hooks if hook.after is not None and hook.after_timer.due(step)]
    if not due:
        return
    current = snapshot()
    for hook in due:
        if hook.prepare is not None:
            hook.prepare(current)
    if profiler is not None:
        profiler.lap(StridePart.SCHEDULE)
    for hook in due:
        if hook.after is not None:
            hook.after(current)
            if profiler is not None:
                profiler.lap(hook.hook)
