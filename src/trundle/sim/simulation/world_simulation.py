"""Simulation: time, commands, hooks and snapshots.

One thread owns it; every other thread posts a command. A stride is: run the commands, call the due `before_step` hooks,
step the engine in C up to the next due time, call the due `after_step` hooks.
"""

from collections.abc import Callable, Mapping
from fractions import Fraction
from functools import partial
from typing import TYPE_CHECKING, TypeAlias

from msgspec.structs import replace

from trundle.base.arguments import count_of, number_of
from trundle.base.diagnostics import Diagnostics, UsageError, no_such
from trundle.base.documented import documented
from trundle.robots.model import Joint, Model, World
from trundle.sim.physics import CompiledWorld, ContactRecorder, Contacts, Engine, StepHooks, compile_world
from trundle.spatial import NS_PER_S

from .actors import ActorPlayer, with_actors
from .applied_loads import AppliedLoads
from .debug_line import DebugLine
from .handles import ModelHandle, handles_of, world_joints_of
from .hooks import AfterStep, BeforeStep
from .inputs import Inputs
from .joint_attachment import with_joint
from .joint_handle import JointHandle
from .profiler import Profiler, StridePart
from .resets import Resets
from .saved_state import SavedSimulation
from .schedule import Schedule, find_actions, finish_stride, run_after, run_before
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
    from trundle.robots.model import AnimationState
    from trundle.sim.physics import BackgroundCutting

_MAX_STRIDE = 1000
"""Maximum number of steps of one stride; an unstable stride is rolled back to its beginning."""
Command: TypeAlias = Callable[["Simulation"], None]


@documented(
    "seed report models time_ns time_s step_ns run step reset save restore snapshot contacts spawn delete rename "
    "add_hook remove_hook on_reset on_change post"
)
class Simulation:
    """World in motion."""

    __module__ = "trundle"

    def __init__(
        self,
        world: World,
        report: Diagnostics,
        *,
        seed: int = 0,
        compiled: CompiledWorld | None = None,
        cutting: "BackgroundCutting | None" = None,
    ) -> None:
        """Compile a world at time zero.

        Args:
            world: world, nested models allowed.
            report: receives the warnings of the compile.
            seed: seed of all random numbers.
            compiled: compiled world with its actors; no other simulation may use it.
            cutting: decomposes slow meshes in the background, for `recompile`; None: all are decomposed first.
        """
        self.report = report
        self.seed = seed
        self._cutting = cutting
        self.engine = Engine(compiled or compile_world(with_actors(world, report), report, cutting=cutting))
        self.world = self.engine.compiled.world
        """World without nested models: their links and joints belong to the outer model, named `inner::name`."""
        self._clock = StepClock(world_step_ns(world))
        self.steps = 0
        self.loads = AppliedLoads(self.engine, lambda: (self.steps, self.step_ns))
        """Loads applied through handles."""
        self._before_resets = (0, 0)
        """Time [ns] and steps before the last reset or restore."""
        self.models = handles_of(self, self.world, {})
        self.joints = world_joints_of(self, self.world, {})
        """Joints between models, in file order."""
        self.lines: dict[str, DebugLine] = {}
        """Lines drawn by plugins, by `model::name`."""
        self.lines_are_shown = False
        """True if a page shows the lines; otherwise plugins skip expensive ones."""
        self.inputs = Inputs[Simulation](self)
        """Commands and callbacks that wait for the next step."""
        self.profiler: Profiler | None = None
        """Charges the wall time of strides to their parts."""
        self._schedule = Schedule[Simulation](self._clock)
        self._recorders: list[tuple[ContactRecorder, Callable[[], bool]]] = []
        self._on_change: list[Callable[[], None]] = []
        self.actors = {
            actor.name: ActorPlayer(actor, self[actor.name])
            for actor in world.actors
            if any(model.name == actor.name for model in self.models)
        }
        """Players of actors; each actor is a model as well."""
        for player in self.actors.values():
            enabled = partial(player.enabled, self.models)
            self.add_hook(player, period_ns=player.period_ns, enabled=enabled)
        self.resets = Resets()
        """Functions called after resets."""

    @property
    def time_ns(self) -> int:
        """Simulation time [ns]."""
        return self._clock.time_ns(self.steps)

    @property
    def time_s(self) -> float:
        """Simulation time [s]."""
        return self.time_ns / NS_PER_S

    @property
    def simulated_ns(self) -> int:
        """Total simulated time [ns], regardless of resets."""
        return self._before_resets[0] + self.time_ns

    @property
    def simulated_steps(self) -> int:
        """Total number of steps, regardless of resets."""
        return self._before_resets[1] + self.steps

    @property
    def step_ns(self) -> int:
        """Length of the next step [ns]; `edit` may change it."""
        return self._clock.step_ns

    def __getitem__(self, name: str) -> ModelHandle:
        """Return a model by name.

        Raises:
            UsageError: no such model; the message lists the models.
        """
        for model in self.models:
            if model.name == name:
                return model
        raise UsageError(no_such("no model", name, [model.name for model in self.models]))

    def __repr__(self) -> str:
        names = ", ".join(repr(model.name) for model in self.models) or "none"
        return f"<{type(self).__name__} {self.world.name!r} at {self.time_ns / NS_PER_S:.3f} s; models: {names}>"

    def animation_state(self, actor: str) -> "AnimationState":
        """Return an actor's animation state; default for a deleted actor."""
        from trundle.robots.model import AnimationState  # worlds without actors do not import it

        player = self.actors.get(actor)
        return AnimationState() if player is None else player.animation_state(self.time_ns)

    # -- time

    def run(self, duration_s: float) -> None:
        """Simulate for a duration [s], as fast as possible.

        Raises:
            UsageError: the duration is negative or no number.
            SimulationUnstableError: the physics became unstable; the world has its last good state.
        """
        duration_s = number_of(duration_s, "duration_s [s]", minimum=0.0)
        self.advance(self.time_ns + round(duration_s * NS_PER_S))

    def step(self, count: int = 1) -> None:
        """Simulate a number of time steps.

        Raises:
            UsageError: the number is negative or not whole.
            SimulationUnstableError: the physics became unstable; the world has its last good state.
        """
        self.advance(self.time_ns + count_of(count, "count") * self.step_ns)

    def advance(self, until_ns: int) -> None:
        """Simulate up to the first step at or after a time [ns].

        If a command or hook resets the time, the remaining duration stays the same.

        Raises:
            SimulationUnstableError: the physics became unstable; the world has its last good state.
        """
        remaining_ns = until_ns - self.time_ns
        while remaining_ns > 0:
            remaining_ns -= self._stride(remaining_ns)
        self._drain()

    def stride(self, until_ns: int) -> None:
        """Simulate up to the next due hook, or to a time [ns] if that comes first.

        Raises:
            SimulationUnstableError: as `advance`.
        """
        self._stride(until_ns - self.time_ns)
        self._drain()

    def set_step(self, step: int) -> None:
        """Set the step of the engine's state after the state was computed elsewhere, such as on a GPU."""
        self.steps = step
        self.loads.expire(step)

    def _stride(self, max_ns: int) -> int:
        """Simulate at most a duration [ns]; return the simulated part."""
        profiler = self.profiler
        if profiler is not None:
            profiler.lap(StridePart.BETWEEN)
        self._drain()
        hooks = self._schedule.enabled(self.steps)
        if profiler is not None:
            profiler.lap(StridePart.SCHEDULE)
        run_before(hooks, self, profiler)
        step_hooks = StepHooks(self.time_ns, self.step_ns, self._enabled_recorders, find_actions(hooks))
        target = self._clock.step_at(self.time_ns + max_ns)
        stop = min([target, self.steps + _MAX_STRIDE, *[hook.next_step for hook in hooks], *self.loads.expiry_steps()])
        if profiler is not None:
            profiler.lap(StridePart.SCHEDULE)
        stepped = self.engine.step(stop - self.steps, None if step_hooks.is_empty else step_hooks)
        if profiler is not None:
            profiler.lap(StridePart.PHYSICS)
        simulated_ns = stepped * self.step_ns
        self.steps += stepped
        finish_stride(hooks)
        self.loads.expire(self.steps)
        run_after(hooks, self.steps, self.snapshot, profiler)
        return simulated_ns

    @property
    def is_recording(self) -> bool:
        """True if a recorder of contacts is enabled."""
        return bool(self._enabled_recorders)

    @property
    def _enabled_recorders(self) -> list[ContactRecorder]:
        return [recorder for recorder, enabled in self._recorders if enabled()]

    def add_hook(
        self,
        hook: "BeforeStep[Simulation] | AfterStep",
        *,
        period_ns: Period = 0,
        enabled: Callable[[], bool] | None = None,
        name: str | None = None,
    ) -> None:
        """Register a periodic hook.

        Args:
            hook: object with before_step(simulation), after_step(snapshot) or both; without either, it is left out.
            period_ns: period [ns]; 0: every step, which costs Python at every step.
            enabled: checked before each stride; while False, the hook costs no stride.
            name: name in a profile; None: the hook's class.

        Raises:
            UsageError: the period is negative or not whole.
        """
        if not isinstance(period_ns, Fraction):
            period_ns = count_of(period_ns, "period_ns [ns]")
        self._schedule.add(hook, period_ns, now_ns=self.time_ns, enabled=enabled, name=name)

    def retime_hook(self, hook: object, period_ns: Period) -> None:
        """Change a hook's period [ns] from now on; the order of hooks stays."""
        self._schedule.retime(hook, period_ns, now_ns=self.time_ns)

    @property
    def hooks(self) -> list[object]:
        """Hooks in order of registration."""
        return self._schedule.hooks

    def hook_name(self, hook: object) -> str | None:
        """Return the name that a hook was registered with."""
        return self._schedule.name_of(hook)

    def remove_hook(self, hook: object) -> None:
        """Remove a hook."""
        self._schedule.remove(hook)

    def add_recorder(self, recorder: ContactRecorder, *, enabled: Callable[[], bool]) -> None:
        """Record contacts at every step from now on, in C++.

        Args:
            recorder: recorder of its collisions' contacts.
            enabled: checked before each stride; while False, recording costs nothing.
        """
        self._recorders.append((recorder, enabled))

    def remove_recorder(self, recorder: ContactRecorder) -> None:
        """Stop recording."""
        self._recorders = [(other, enabled) for other, enabled in self._recorders if other is not recorder]

    # -- state

    def snapshot(self) -> Snapshot:
        """Return a snapshot of the current state."""
        compiled = self.engine.compiled
        return Snapshot(
            time_ns=self.time_ns,
            instant=self.engine.snapshot(),
            first_axes=compiled.first_axes,
            joint_axes=compiled.joint_axes,
        )

    def contacts(self, among: frozenset[str] | None = None) -> Contacts:
        """Return the contacts of the last step, one by one or as arrays of positions, normals and forces.

        Args:
            among: names `model::link::collision`, at least one of which is part of each contact; None: all contacts.
        """
        return self.engine.contacts(among)

    def save(self) -> SavedSimulation:
        """Save the complete state."""
        return SavedSimulation(self.steps, self._clock, self.engine.save(), self.loads.expiries.copy())

    def restore(self, saved: SavedSimulation) -> None:
        """Restore a saved state; hooks restart at its time."""
        simulated_ns, simulated_steps = self.simulated_ns, self.simulated_steps
        self.steps = saved.steps
        self.engine.restore(saved.engine)
        self.loads.restore(saved.expiries)
        self._set_clock(saved.clock)
        self._before_resets = (simulated_ns - self.time_ns, simulated_steps - self.steps)
        self._schedule.restart(self.steps)

    def reset(self, *, time: bool = True, poses: bool = True) -> None:
        """Return to the initial state.

        Args:
            time: reset the time to zero.
            poses: reset poses as loaded, at rest, with motors off and no loads.
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
            self.resets.finish()

    def on_reset(self, call: Callable[[], None], *, model: ModelHandle | None = None) -> None:
        """Call a function after each reset of poses, and after each reset of `model`, until it is deleted."""
        self.resets.add(call, model)

    # -- spawning and deleting

    def spawn(self, model: Model, *, allow_renaming: bool = False) -> ModelHandle:
        """Add a model; everything else keeps its exact state.

        Args:
            model: model, added at its pose.
            allow_renaming: append _0, _1, … to a name that is taken, as Gazebo does.

        Raises:
            UsageError: the name is taken.
            DescriptionError: MuJoCo cannot simulate the result; nothing has changed.
        """
        if allow_renaming:
            model = replace(model, name=unique_name(self.world, model.name))
        check_name_is_free(self.world, model.name)
        self._replace_world(replace(self.world, models=(*self.world.models, model)))
        return self.models[-1]

    def delete(self, name: str) -> None:
        """Delete a model and its joints with others; everything else keeps its exact state.

        Raises:
            UsageError: no such model; the message lists the models.
        """
        handle = self[name]
        self._replace_world(without_model(self.world, name))
        handle.rebind(None, None)
        self.resets.forget(handle)
        self.lines = {key: line for key, line in self.lines.items() if not key.startswith(f"{name}::")}

    def rename(self, name: str, new: str) -> None:
        """Rename a model; everything keeps its exact state, and handles stay valid.

        Raises:
            UsageError: there is no such model, or the new name is taken.
        """
        handle = self[name]
        if new == name:
            return
        check_name_is_free(self.world, new)
        self._replace_world(with_model_renamed(self.world, name, new), renamed={new: handle})
        self.lines = {key.replace(f"{name}::", f"{new}::", 1): line for key, line in self.lines.items()}
        self._schedule.rename_model(name, new)

    def attach(self, joint: Joint) -> JointHandle:
        """Attach a link to another or to the world in the current configuration; all poses stay.

        Args:
            joint: joint with links `model::link` or "world", its frame in the child's, axes in the world as posed now.

        Raises:
            UsageError: a link does not exist, or the joint's name is taken.
            DescriptionError: MuJoCo cannot simulate the result; nothing has changed.
        """
        self._replace_world(with_joint(self.world, self.models, joint))
        return self.joints[-1]

    def detach(self, name: str) -> None:
        """Remove a joint between models; poses and velocities stay, and the child is free.

        Raises:
            UsageError: no such joint; the message lists the joints.
        """
        self._replace_world(without_joint(self.world, name))

    def edit(self, world: World) -> None:
        """Change time step, gravity, masses, surfaces or limits; everything keeps its exact state.

        Args:
            world: this simulation's world, edited, with the same models, links and joints.

        Raises:
            UsageError: the world has other models, links or joints.
            DescriptionError: MuJoCo cannot simulate the result; nothing has changed.
        """
        check_same_structure(self.world, world)
        self._replace_world(world)

    def recompile(self) -> None:
        """Compile the world again in the same state, with the pieces of meshes decomposed in the background."""
        self._replace_world(self.world)

    def on_change(self, call: Callable[[], None]) -> None:
        """Call a function after models were spawned, deleted or edited, which may change indices."""
        self._on_change.append(call)

    def _replace_world(self, world: World, *, renamed: Mapping[str, ModelHandle] | None = None) -> None:
        """Compile a changed world and transfer the state.

        Args:
            world: changed world.
            renamed: renamed models, new name → handle.
        """
        renamed = renamed or {}
        self.engine, links = transferred_engine(
            self.engine, world, self.report, {old.name: new for new, old in renamed.items()}, self._cutting
        )
        self.world = self.engine.compiled.world
        self.models[:] = handles_of(self, self.world, {handle.name: handle for handle in self.models} | dict(renamed))
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
        """Queue a function that is called with the simulation before its next step; thread-safe."""
        self.inputs.post(command)

    def _drain(self) -> None:
        if self.inputs.run() and self.profiler is not None:
            self.profiler.lap(StridePart.COMMANDS)
