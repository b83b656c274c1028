"""The running world: time, commands in, snapshots out, hooks when they are due.

One thread owns it; every other thread posts a command. A stride is: drain commands, call the `before_step` hooks that
are due, let the engine step in C up to the next due time, call the `after_step` hooks that are due then.
"""

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TypeAlias

from trundle.diagnostics import Diagnostics, UsageError
from trundle.model import Joint, Model, World
from trundle.physics import Contact, Engine, EngineState, GripLaw, compile_world
from trundle.spatial import Pose, Twist, Wrench

from .attaching import attached
from .handles import ModelHandle, handles_of
from .hooks import AfterStep, BeforeStep, Period, ScheduledHook
from .joint_handle import JointHandle
from .line import Line
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
        self.models = handles_of(self, self.world, {})
        first = self._first_world_joint
        self.joints = [JointHandle(self, joint, first + i) for i, joint in enumerate(self.world.joints)]
        """Between models, in file order."""
        self.lines: dict[str, Line] = {}
        """What plugins draw, by `model::name`."""
        self._commands: deque[Command] = deque()
        self._hooks: list[ScheduledHook] = []
        self._on_change: list[Callable[[], None]] = []
        self._on_reset: list[Callable[[], None]] = []
        self._wrench_ends: dict[int, int] = {}
        """Link → the step after which its wrench ends."""
        self._added_to: dict[int, Wrench] = {}
        """Link → its lasting wrench, below what was added for the coming step."""
        self._grips: dict[int, GripLaw] = {}

    @property
    def _first_world_joint(self) -> int:
        return sum(len(model.joints) for model in self.world.models)

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
        self, hook: BeforeStep | AfterStep, *, period_ns: Period = 0, wanted: Callable[[], bool] | None = None
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

    def joint_reaction(self, joint: int) -> Wrench:
        """See `JointHandle.reaction`; by the joint's index."""
        engine = self.engine
        link, anchor, sign = engine.compiled.joint_hangs[joint]
        if link < 0:
            name = engine.compiled.joint_names[joint]
            raise UsageError(f"joint {name!r} closes a loop of links, or holds none; its reaction is not known")
        _, _, _, qw, qx, qy, qz = engine.reader.link_poses()[link].tolist()
        x, y, z = Pose(quaternion=(qw, qx, qy, qz)).direction(anchor)
        fx, fy, fz, tx, ty, tz = engine.reactions()[link].tolist()
        moved = (tx - (y * fz - z * fy), ty - (z * fx - x * fz), tz - (x * fy - y * fx))
        return Wrench((sign * fx, sign * fy, sign * fz), (sign * moved[0], sign * moved[1], sign * moved[2]))

    def save(self) -> SavedSimulation:
        """Keep the state, to go back to it exactly."""
        return SavedSimulation(self.steps, self.engine.save(), dict(self._wrench_ends))

    def restore(self, saved: SavedSimulation) -> None:
        """Go back to a saved state; hooks are due as if time had just got there."""
        self.steps = saved.steps
        self.engine.restore(saved.engine)
        self._wrench_ends = dict(saved.wrench_ends)
        self._added_to.clear()
        for hook in self._hooks:
            hook.restart(self.steps, self.step_ns)

    def reset(self) -> None:
        """Go back to time zero: poses as loaded, motors off, nothing applied."""
        self.steps = 0
        self.engine.reset()
        self._wrench_ends.clear()
        self._added_to.clear()
        for hook in self._hooks:
            hook.restart(0, self.step_ns)
        for call in self._on_reset:
            call()

    def on_reset(self, call: Callable[[], None]) -> None:
        """Have a function called after each reset."""
        self._on_reset.append(call)

    # -- models that come and go

    def spawn(self, model: Model) -> ModelHandle:
        """Add a model; everything else stays as it is, to the bit.

        Raises:
            UsageError: there is one of that name.
            DescriptionError: the engine cannot simulate it; nothing has changed.
        """
        if any(there.name == model.name for there in self.world.models):
            raise UsageError(f"there is a model {model.name!r} already")
        self._go_on_with(replace(self.world, models=(*self.world.models, model)))
        return self.models[-1]

    def delete(self, name: str) -> None:
        """Take a model out; everything else stays as it is, to the bit, and its handles remain good.

        Raises:
            UsageError: with the names there are.
        """
        gone = self[name]
        self._go_on_with(replace(self.world, models=tuple(m for m in self.world.models if m.name != name)))
        gone.move_to(None, None)
        self.lines = {key: line for key, line in self.lines.items() if not key.startswith(f"{name}::")}

    def attach(self, joint: Joint) -> JointHandle:
        """Join two links, or one and the world, where they are now; everything keeps its place.

        Args:
            joint: links by `model::link` or "world", the frame in the child's, axes in the world as they lie now.

        Raises:
            UsageError: there is no such link, or such a joint already.
            DescriptionError: the engine cannot simulate it; nothing has changed.
        """
        self._go_on_with(attached(self.world, self.models, joint))
        return self.joints[-1]

    def detach(self, name: str) -> None:
        """Take a joint between models away; everything keeps its place and speed, what hung from it is free.

        Raises:
            UsageError: with the names there are.
        """
        if not any(joint.name == name for joint in self.joints):
            there = ", ".join(repr(joint.name) for joint in self.joints) or "none"
            raise UsageError(f"no joint {name!r} between models; there are: {there}")
        gone = next(joint for joint in self.joints if joint.name == name)
        self._go_on_with(replace(self.world, joints=tuple(j for j in self.world.joints if j.name != name)))
        gone.move_to(None)

    def fix_elsewhere(self, handle: ModelHandle, world_from_model: Pose) -> None:
        """Put a model that hangs from the world elsewhere; see `ModelHandle.set_pose`."""
        moved = replace(handle.model, world_from_model=world_from_model)
        self.edit(replace(self.world, models=tuple(moved if m.name == handle.name else m for m in self.world.models)))

    def edit(self, world: World) -> None:
        """Go on with other gravity, masses, surfaces or limits; everything keeps its state, to the bit.

        Args:
            world: this simulation's, with whatever is to be different; the same models, links and joints.

        Raises:
            UsageError: the time step, or what there is, is different.
            DescriptionError: the engine cannot simulate it; nothing has changed.
        """
        if world.physics.max_step_size_s != self.world.physics.max_step_size_s:
            raise UsageError("the time step of a running simulation cannot be changed")
        if _names_of(world) != _names_of(self.world):
            raise UsageError("an edited world has other models, links or joints; spawn and delete change those")
        self._go_on_with(world)

    def on_change(self, call: Callable[[], None]) -> None:
        """Have a function called after models came, went or were edited: indices may be others."""
        self._on_change.append(call)

    def _go_on_with(self, world: World) -> None:
        old = self.engine
        engine = Engine(compile_world(world, self.report))
        engine.take_over(old)
        _keep_free(old, engine)
        self.engine, self.world = engine, engine.compiled.world
        links = {name: index for index, name in enumerate(engine.compiled.link_names)}
        names = old.compiled.link_names
        self._wrench_ends = {links[names[link]]: end for link, end in self._wrench_ends.items() if names[link] in links}
        self._added_to = {links[names[link]]: w for link, w in self._added_to.items() if names[link] in links}
        self._grips = {links[names[link]]: law for link, law in self._grips.items() if names[link] in links}
        if self._grips:
            engine.set_grips(self._grips)
        known = {handle.name: handle for handle in self.models}
        self.models[:] = handles_of(self, self.world, known)
        joints = {handle.name: handle for handle in self.joints}
        self.joints[:] = [joints.get(joint.name) or JointHandle(self, joint, 0) for joint in self.world.joints]
        for i, joint in enumerate(self.joints, self._first_world_joint):
            joint.move_to(i)
        for call in self._on_change:
            call()

    # -- commands

    def post(self, command: Command) -> None:
        """Have a function called with the simulation before its next step; from any thread."""
        self._commands.append(command)

    def _drain(self) -> None:
        for _ in range(len(self._commands)):
            self._commands.popleft()(self)

    def apply_wrench(self, link: int, wrench: Wrench, *, duration_s: float | None = None) -> None:
        """Push and twist a link, by its index; see `LinkHandle.apply_wrench`."""
        self._added_to.pop(link, None)
        self.engine.set_wrench(link, wrench)
        self._wrench_ends.pop(link, None)
        if duration_s is not None:
            self._wrench_ends[link] = self.steps + max(1, round(duration_s * NS / self.step_ns))

    def add_wrench(self, link: int, wrench: Wrench) -> None:
        """Add to what pushes a link, up to the next hook; see `LinkHandle.add_wrench`."""
        now = self.engine.wrench(link)
        self._added_to.setdefault(link, now)
        self.engine.set_wrench(link, now + wrench)

    def set_grip(self, link: int, law: GripLaw | None) -> None:
        """Have the contacts of a link, by its index, follow a law; see `LinkHandle.set_grip`."""
        if law is None:
            self._grips.pop(link, None)
        else:
            self._grips[link] = law
        self.engine.set_grips(self._grips)

    def _end_wrenches(self) -> None:
        for link, lasting in self._added_to.items():
            self.engine.set_wrench(link, lasting)
        self._added_to.clear()
        for link in [link for link, end in self._wrench_ends.items() if end <= self.steps]:
            del self._wrench_ends[link]
            self.engine.set_wrench(link, Wrench())


def _keep_free(old: Engine, engine: Engine) -> None:
    """Links that hung from something and are free now stay where they are, as fast as they were."""
    links = {name: index for index, name in enumerate(old.compiled.link_names)}
    poses, twists = old.reader.link_poses(), old.reader.link_twists()
    for link, name in enumerate(engine.compiled.link_names):
        before = links.get(name)
        if before is not None and engine.is_free(link) and not old.is_free(before):
            x, y, z, qw, qx, qy, qz = poses[before].tolist()
            vx, vy, vz, wx, wy, wz = twists[before].tolist()
            engine.set_tree_pose(link, Pose((x, y, z), (qw, qx, qy, qz)))
            engine.set_tree_twist(link, Twist((vx, vy, vz), (wx, wy, wz)))


def _names_of(world: World) -> list[tuple[str, list[str], list[str]]]:
    return [(m.name, [link.name for link in m.links], [joint.name for joint in m.joints]) for m in world.models]
