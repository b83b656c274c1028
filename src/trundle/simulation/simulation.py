"""The running world: time, commands in, snapshots out, hooks when they are due.

One thread owns it; every other thread posts a command. A stride is: drain commands, call the `before_step` hooks that
are due, let the engine step in C up to the next due time, call the `after_step` hooks that are due then.
"""

from collections import deque
from collections.abc import Callable, Mapping
from functools import partial
from typing import TYPE_CHECKING, TypeAlias

from msgspec.structs import replace

from trundle.diagnostics import Diagnostics, UsageError
from trundle.model import Joint, Model, World
from trundle.physics import Contact, Engine, compile_world
from trundle.spatial import NS_PER_S

from .actors import ActorPlayer, with_actors
from .applied_loads import AppliedLoads
from .debug_line import DebugLine
from .handles import ModelHandle, handles_of, world_joints_of
from .hooks import AfterStep, BeforeStep
from .joint_attachment import with_joint
from .joint_handle import JointHandle
from .saved_state import SavedSimulation
from .schedule import Schedule, run_after, run_before
from .snapshot import Snapshot
from .step_clock import Period, StepClock, world_step_ns
from .world_edits import (
    check_name_is_free,
    check_same_structure,
    transferred_engine,
    unique_name,
    with_model_renamed,
    without_joint,
    without_model,
)

if TYPE_CHECKING:
    from trundle.model import AnimationState

_MAX_STRIDE = 1000
"""Steps in one stride: what blows up is undone to its beginning."""
Command: TypeAlias = Callable[["Simulation"], None]


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
        self.engine = Engine(compile_world(with_actors(world, report), report))
        self.world = self.engine.compiled.world
        """Without nested models: their links and joints are the outer model's, called `inner::name`."""
        self.loads = AppliedLoads(self.engine)
        """What handles have pushed."""
        self._clock = StepClock(world_step_ns(world))
        self.steps = 0
        self._before_resets = (0, 0)
        """Time [ns] and steps that resets and restored states have taken back."""
        self.models = handles_of(self, self.world, {})
        self.joints = world_joints_of(self, self.world, {})
        """Between models, in file order."""
        self.lines: dict[str, DebugLine] = {}
        """What plugins draw, by `model::name`."""
        self.lines_are_shown = False
        """Whether a viewer shows them; a plugin whose lines cost much draws none until then."""
        self._commands: deque[Command] = deque()
        self._schedule = Schedule(self._clock)
        self._on_change: list[Callable[[], None]] = []
        self.actors = {
            actor.name: ActorPlayer(actor, self[actor.name])
            for actor in world.actors
            if any(model.name == actor.name for model in self.models)
        }
        """What moves them; each is a model as well."""
        for walk in self.actors.values():
            wanted = partial(walk.enabled, self.models)
            self.add_hook(walk, period_ns=walk.period_ns, enabled=wanted)
        self._on_reset: list[Callable[[], None]] = []

    @property
    def time_ns(self) -> int:
        """Simulation time [ns]."""
        return self._clock.time_ns(self.steps)

    @property
    def simulated_ns(self) -> int:
        """How much has been simulated [ns], whatever resets have taken back."""
        return self._before_resets[0] + self.time_ns

    @property
    def simulated_steps(self) -> int:
        """In how many steps."""
        return self._before_resets[1] + self.steps

    @property
    def step_ns(self) -> int:
        """How long the next step is [ns]; `edit` may change it."""
        return self._clock.step_ns

    def __getitem__(self, name: str) -> ModelHandle:
        """The model of that name.

        Raises:
            UsageError: with the names there are.
        """
        for model in self.models:
            if model.name == name:
                return model
        raise UsageError(f"no model {name!r}; there are: {', '.join(repr(m.name) for m in self.models) or 'none'}")

    def animation_state(self, actor: str) -> "AnimationState":
        """What the bones of an actor are at now; one that is gone stands."""
        from trundle.model import AnimationState  # a world without actors starts without theirs

        walk = self.actors.get(actor)
        return AnimationState() if walk is None else walk.animation_state(self.time_ns)

    # -- time

    def run(self, duration_s: float) -> None:
        """Simulate so many seconds, flat out."""
        self.advance(self.time_ns + round(duration_s * NS_PER_S))

    def step(self, count: int = 1) -> None:
        """Simulate so many time steps."""
        self.advance(self.time_ns + count * self.step_ns)

    def advance(self, until_ns: int) -> None:
        """Simulate up to a time [ns]; it ends at the first step that reaches it.

        Where a command or a hook takes time back, what was left to simulate is left.

        Raises:
            SimulationUnstableError: the physics blew up; the world stands where it last was sound.
        """
        left_ns = until_ns - self.time_ns
        while left_ns > 0:
            left_ns -= self._stride(left_ns)
        self._drain()

    def stride(self, until_ns: int) -> None:
        """Simulate up to the next instant at which a hook is called, or to a time [ns] if that comes first.

        Raises:
            SimulationUnstableError: as `advance`.
        """
        self._stride(until_ns - self.time_ns)
        self._drain()

    def _stride(self, most_ns: int) -> int:
        """Simulate so much or less [ns]; return how much it was."""
        self._drain()
        hooks = self._schedule.enabled(self.steps)
        run_before(hooks, self)
        target = self._clock.step_at(self.time_ns + most_ns)
        stop = min([target, self.steps + _MAX_STRIDE, *[hook.next_step for hook in hooks], *self.loads.expiry_steps()])
        simulated_ns = (stop - self.steps) * self.step_ns
        self.engine.step(stop - self.steps)
        self.steps = stop
        self.loads.expire(self.steps)
        run_after(hooks, self.steps, self.snapshot)
        return simulated_ns

    def add_hook(
        self, hook: BeforeStep | AfterStep, *, period_ns: Period = 0, enabled: Callable[[], bool] | None = None
    ) -> None:
        """Have a hook called as time passes.

        Args:
            hook: an object with before_step(simulation), after_step(snapshot) or both.
            period_ns: how often [ns]; 0: at every step, which costs Python at every step.
            enabled: asked before each stride; while it says no, the hook costs no stride.
        """
        self._schedule.add(hook, period_ns, now_ns=self.time_ns, enabled=enabled)

    def retime_hook(self, hook: object, period_ns: Period) -> None:
        """Call a hook from now on at another period [ns]; it keeps its turn among the others."""
        self._schedule.retime(hook, period_ns, now_ns=self.time_ns)

    def remove_hook(self, hook: object) -> None:
        """Call a hook no more."""
        self._schedule.remove(hook)

    # -- state

    def snapshot(self) -> Snapshot:
        """Where everything is now."""
        compiled = self.engine.compiled
        return Snapshot(
            time_ns=self.time_ns,
            instant=self.engine.snapshot(),
            first_axes=compiled.first_axes,
            joint_axes=compiled.joint_axes,
        )

    def contacts(self, among: frozenset[str] | None = None) -> list[Contact]:
        """What touched what in the last step; among: only what touched collisions of these names."""
        return self.engine.contacts(among)

    def save(self) -> SavedSimulation:
        """Keep the state, to go back to it exactly."""
        return SavedSimulation(self.steps, self._clock, self.engine.save(), self.loads.expiries.copy())

    def restore(self, saved: SavedSimulation) -> None:
        """Go back to a saved state; hooks are due as if time had just got there."""
        simulated_ns, simulated_steps = self.simulated_ns, self.simulated_steps
        self.steps = saved.steps
        self.engine.restore(saved.engine)
        self.loads.restore(saved.expiries)
        self._set_clock(saved.clock)
        self._before_resets = (simulated_ns - self.time_ns, simulated_steps - self.steps)
        self._schedule.restart(self.steps)

    def reset(self, *, time: bool = True, poses: bool = True) -> None:
        """Go back to the start.

        Args:
            time: to zero; else it goes on.
            poses: as loaded, at rest, motors off, nothing applied; else everything stays as it is.
        """
        steps = self.steps
        if poses:
            self.engine.reset()
            self.loads.clear()
        if time:
            self._before_resets = (self.simulated_ns, self.simulated_steps)
            self.steps = 0
            self.loads.shift(-steps)
            self._set_clock(StepClock(self.step_ns))
            self._schedule.restart(0)
        self.engine.set_time(self.time_ns / NS_PER_S)
        if poses:
            for call in self._on_reset:
                call()

    def on_reset(self, call: Callable[[], None]) -> None:
        """Have a function called after each reset of poses."""
        self._on_reset.append(call)

    # -- models that come and go

    def spawn(self, model: Model, *, allow_renaming: bool = False) -> ModelHandle:
        """Add a model; everything else stays as it is, to the bit.

        Args:
            model: put where its pose says.
            allow_renaming: where there is one of that name, add _0 to it, else _1, …, as Gazebo does.

        Raises:
            UsageError: there is one of that name.
            DescriptionError: the engine cannot simulate it; nothing has changed.
        """
        if allow_renaming:
            model = replace(model, name=unique_name(self.world, model.name))
        check_name_is_free(self.world, model.name)
        self._replace_world(replace(self.world, models=(*self.world.models, model)))
        return self.models[-1]

    def delete(self, name: str) -> None:
        """Take a model out, and what joined it with others; everything else stays as it is, to the bit.

        Raises:
            UsageError: with the names there are.
        """
        gone = self[name]
        self._replace_world(without_model(self.world, name))
        gone.rebind(None, None)
        self.lines = {key: line for key, line in self.lines.items() if not key.startswith(f"{name}::")}

    def rename(self, name: str, new: str) -> None:
        """Give a model another name; everything stays as it is, to the bit, and its handle remains good.

        Raises:
            UsageError: there is none of that name, or one of the new one.
        """
        handle = self[name]
        if new == name:
            return
        check_name_is_free(self.world, new)
        self._replace_world(with_model_renamed(self.world, name, new), was={new: handle})
        self.lines = {key.replace(f"{name}::", f"{new}::", 1): line for key, line in self.lines.items()}

    def attach(self, joint: Joint) -> JointHandle:
        """Join two links, or one and the world, where they are now; everything keeps its place.

        Args:
            joint: links by `model::link` or "world", the frame in the child's, axes in the world as they lie now.

        Raises:
            UsageError: there is no such link, or such a joint already.
            DescriptionError: the engine cannot simulate it; nothing has changed.
        """
        self._replace_world(with_joint(self.world, self.models, joint))
        return self.joints[-1]

    def detach(self, name: str) -> None:
        """Take a joint between models away; everything keeps its place and speed, what hung from it is free.

        Raises:
            UsageError: with the names there are.
        """
        self._replace_world(without_joint(self.world, name))

    def edit(self, world: World) -> None:
        """Go on with another time step, gravity, masses, surfaces or limits; all keep their state, to the bit.

        Args:
            world: this simulation's, with whatever is to be different; the same models, links and joints.

        Raises:
            UsageError: what there is, is different.
            DescriptionError: the engine cannot simulate it; nothing has changed.
        """
        check_same_structure(self.world, world)
        self._replace_world(world)

    def on_change(self, call: Callable[[], None]) -> None:
        """Have a function called after models came, went or were edited: indices may be others."""
        self._on_change.append(call)

    def _replace_world(self, world: World, *, was: Mapping[str, ModelHandle] | None = None) -> None:
        """Compile a changed world and carry everything over.

        Args:
            world: the changed one.
            was: models that had another name, by the new one.
        """
        was = was or {}
        self.engine, links = transferred_engine(
            self.engine, world, self.report, {old.name: new for new, old in was.items()}
        )
        self.world = self.engine.compiled.world
        self.models[:] = handles_of(self, self.world, {handle.name: handle for handle in self.models} | dict(was))
        self.joints[:] = world_joints_of(self, self.world, {handle.name: handle for handle in self.joints})
        self.loads.transfer_to(links, self.engine)
        clock = self._clock.with_step(world_step_ns(world), since=self.steps)
        self.loads.retime(self._clock, clock)
        self._set_clock(clock)
        for call in self._on_change:
            call()

    def _set_clock(self, clock: StepClock) -> None:
        self._clock = clock
        self._schedule.set_clock(clock)

    # -- commands

    def post(self, command: Command) -> None:
        """Have a function called with the simulation before its next step; from any thread."""
        self._commands.append(command)

    def _drain(self) -> None:
        for _ in range(len(self._commands)):
            self._commands.popleft()(self)

    def expiry_step(self, duration_s: float | None) -> int | None:
        """The step at which what begins now and lasts so long is over; None: it lasts."""
        return None if duration_s is None else self.steps + max(1, round(duration_s * NS_PER_S / self.step_ns))
