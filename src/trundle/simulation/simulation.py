"""The running world: time, commands in, snapshots out, hooks when they are due.

One thread owns it; every other thread posts a command. A stride is: drain commands, call the `before_step` hooks that
are due, let the engine step in C up to the next due time, call the `after_step` hooks that are due then.
"""

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

from trundle.diagnostics import Diagnostics, UsageError
from trundle.model import World
from trundle.physics import Contact, Engine, EngineState, compile_world
from trundle.spatial import Wrench

from .handles import JointHandle, ModelHandle
from .hooks import AfterStep, BeforeStep, ScheduledHook
from .snapshot import Snapshot

NS = 1_000_000_000
_LONGEST = 1000
"""Steps in one stride: what blows up is undone to its beginning."""
Command: TypeAlias = Callable[["Simulation"], None]


@dataclass(frozen=True, slots=True)
class SavedSimulation:
    """A state to go back to."""

    steps: int
    engine: EngineState
    wrench_ends: dict[int, int]


class Simulation:
    """One world in motion."""

    def __init__(self, world: World, report: Diagnostics, *, seed: int = 0) -> None:
        """Compile a world; time is zero and nothing has moved.

        Args:
            world: what there is.
            report: takes what physics has to mend.
            seed: of everything random.
        """
        self.report = report
        self.seed = seed
        self.engine = Engine(compile_world(world, report))
        self.world = self.engine.compiled.world
        """Without nested models: their links and joints are the outer model's, called `inner::name`."""
        self.step_ns = round(world.physics.max_step_size_s * NS)
        self.steps = 0
        self.models = _handles(self, self.world)
        first = sum(len(model.joints) for model in self.world.models)
        self.joints = [JointHandle(self, joint, first + i) for i, joint in enumerate(self.world.joints)]
        """Between models, in file order."""
        self._commands: deque[Command] = deque()
        self._hooks: list[ScheduledHook] = []
        self._on_reset: list[Callable[[], None]] = []
        self._wrench_ends: dict[int, int] = {}
        """Link → the step after which its wrench ends."""

    @property
    def time_ns(self) -> int:
        """Simulation time [ns]."""
        return self.steps * self.step_ns

    def __getitem__(self, name: str) -> ModelHandle:
        """The model of that name.

        Raises:
            UsageError: with the names there are.
        """
        for model in self.models:
            if model.name == name:
                return model
        raise UsageError(f"no model {name!r}; there are: {', '.join(repr(m.name) for m in self.models) or 'none'}")

    # -- time

    def run(self, duration_s: float) -> None:
        """Simulate so many seconds, flat out."""
        self.advance(self.time_ns + round(duration_s * NS))

    def step(self, count: int = 1) -> None:
        """Simulate so many time steps."""
        self.advance(self.time_ns + count * self.step_ns)

    def advance(self, until_ns: int) -> None:
        """Simulate up to a time [ns]; it ends at the first step that reaches it.

        Raises:
            SimulationUnstableError: the physics blew up; the world stands where it last was sound.
        """
        target = -(-until_ns // self.step_ns)
        while self.steps < target:
            self._drain()
            hooks = [hook for hook in self._hooks if hook.wakes(self.steps, self.step_ns)]
            for hook in hooks:
                if hook.before is not None and hook.before_alarm.rings(self.steps):
                    hook.before(self)
            stop = min(
                [target, self.steps + _LONGEST, *(hook.next_step for hook in hooks), *self._wrench_ends.values()]
            )
            self.engine.step(stop - self.steps)
            self.steps = stop
            self._end_wrenches()
            self._look(hooks)
        self._drain()

    def _look(self, hooks: list[ScheduledHook]) -> None:
        due = [hook.after for hook in hooks if hook.after is not None and hook.after_alarm.rings(self.steps)]
        if due:
            snapshot = self.snapshot()
            for after in due:
                after(snapshot)

    def add_hook(
        self, hook: BeforeStep | AfterStep, *, period_ns: int = 0, wanted: Callable[[], bool] | None = None
    ) -> None:
        """Have a hook called as time passes.

        Args:
            hook: an object with before_step(simulation), after_step(snapshot) or both.
            period_ns: how often [ns]; 0: at every step, which costs Python at every step.
            wanted: asked before each stride; while it says no, the hook costs no stride.
        """
        self._hooks.append(ScheduledHook(hook, period_ns, self.step_ns, now_ns=self.time_ns, wanted=wanted))

    # -- state

    def snapshot(self) -> Snapshot:
        """Where everything is now."""
        compiled = self.engine.compiled
        return Snapshot(
            time_ns=self.time_ns,
            instant=self.engine.instant(),
            first_axes=compiled.first_axes,
            joint_axes=compiled.joint_axes,
        )

    def contacts(self) -> list[Contact]:
        """What touched what in the last step."""
        return self.engine.contacts()

    def save(self) -> SavedSimulation:
        """Keep the state, to go back to it exactly."""
        return SavedSimulation(self.steps, self.engine.save(), dict(self._wrench_ends))

    def restore(self, saved: SavedSimulation) -> None:
        """Go back to a saved state; hooks are due as if time had just got there."""
        self.steps = saved.steps
        self.engine.restore(saved.engine)
        self._wrench_ends = dict(saved.wrench_ends)
        for hook in self._hooks:
            hook.restart(self.steps, self.step_ns)

    def reset(self) -> None:
        """Go back to time zero: poses as loaded, motors off, nothing applied."""
        self.steps = 0
        self.engine.reset()
        self._wrench_ends.clear()
        for hook in self._hooks:
            hook.restart(0, self.step_ns)
        for call in self._on_reset:
            call()

    def on_reset(self, call: Callable[[], None]) -> None:
        """Have a function called after each reset."""
        self._on_reset.append(call)

    # -- commands

    def post(self, command: Command) -> None:
        """Have a function called with the simulation before its next step; from any thread."""
        self._commands.append(command)

    def _drain(self) -> None:
        for _ in range(len(self._commands)):
            self._commands.popleft()(self)

    def apply_wrench(self, link: int, wrench: Wrench, *, duration_s: float | None = None) -> None:
        """Push and twist a link, by its index; see `LinkHandle.apply_wrench`."""
        self.engine.set_wrench(link, wrench)
        self._wrench_ends.pop(link, None)
        if duration_s is not None:
            self._wrench_ends[link] = self.steps + max(1, round(duration_s * NS / self.step_ns))

    def _end_wrenches(self) -> None:
        for link in [link for link, end in self._wrench_ends.items() if end <= self.steps]:
            del self._wrench_ends[link]
            self.engine.set_wrench(link, Wrench())


def _handles(simulation: Simulation, world: World) -> list[ModelHandle]:
    handles: list[ModelHandle] = []
    link, joint = 0, 0
    for model in world.models:
        handles.append(ModelHandle(simulation, model, first_link=link, first_joint=joint))
        link += len(model.links)
        joint += len(model.joints)
    return handles
