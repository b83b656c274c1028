"""The simulation of a launch: what gzserver opens, spawn_model fills and gzclient shows, on a thread of its own."""

import asyncio
import threading
import time
from collections import deque
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from trundle.bridge import ClockTopic
from trundle.description import load
from trundle.diagnostics import Diagnostics, TrundleError, UsageError
from trundle.model import Model, World
from trundle.packages import Packages
from trundle.physics import RayRenderer
from trundle.render import scene_of
from trundle.ros import Node, SimClock
from trundle.sensors import CameraSensor, mount_cameras
from trundle.simulation import ModelHandle, Simulation, SimulationUnstableError
from trundle.spatial import Pose

from .gazebo_models import read_spawned
from .graph import Graph
from .pace import Pacer
from .page import Page
from .plugins import load_plugins

_IDLE_S = 0.01
_END_S = 2.0
_CALL_S = 30.0


@dataclass(frozen=True, slots=True, kw_only=True)
class _Arrival:
    """Where a model was when it came, for resets."""

    world_from_model: Pose
    joints: dict[str, float]


class GazeboWorld:
    """Owns one simulation; see `trundle.nodes.Simulator` for what may be called from where."""

    def __init__(
        self,
        *,
        graph: Graph,
        packages: Packages,
        env: Mapping[str, str],
        report: Diagnostics,
        folder: Path,
        say: Callable[[str], None],
        window: tuple[str, int | None] | None,
    ) -> None:
        """Get ready; nothing is simulated before `open`.

        Args:
            graph: where its nodes live.
            packages: where URIs lead.
            env: for plugins.
            report: takes what files and physics leave to be said.
            folder: takes the text of each spawned model, which messages name lines of.
            say: tells the user a thing.
            window: host and port of the page; None: headless.
        """
        self._graph = graph
        self._packages = packages
        self._env = env
        self._report = report
        self._folder = folder
        self._say = say
        self._window = window
        self._thread: threading.Thread | None = None
        self._commands: deque[Callable[[], None]] = deque()
        self._ending = threading.Event()
        self._simulation: Simulation | None = None
        self._cameras: list[CameraSensor] = []
        self._plugin_nodes: list[Node] = []
        self._arrivals: dict[str, _Arrival] = {}
        self._clock = SimClock(graph.loop)
        self._pacer = Pacer(1.0)
        self._page: Page | None = None
        self._node: Node | None = None
        self._paused = False

    # -- any thread

    async def open(self, node: Node, world: str, *, paused: bool) -> None:
        """Read a world and let it run."""
        if self._thread is not None:
            raise UsageError("a simulation runs already; a launch has one")
        self._node, self._paused = node, paused
        loaded = await asyncio.to_thread(load, world, self._report, packages=self._packages)
        if loaded.kind != "world":
            raise UsageError(f"{world} is a model; a world is needed")
        self._thread = threading.Thread(target=self._work, name="trundle-gazebo", daemon=True)
        built = asyncio.get_running_loop().create_future()

        def build() -> None:
            error: TrundleError | None = None
            try:
                self._build(loaded.world, time_ns=0, joints={})
            except TrundleError as failure:
                error = failure
            self._graph.loop.call_soon(lambda: built.set_exception(error) if error else built.set_result(None))

        self.post(build)
        self._thread.start()
        await built

    def post(self, call: Callable[[], None]) -> None:
        """Have a function called between two strides."""
        self._commands.append(call)

    async def show(self, node: Node) -> int:
        """Open the page, once there is something to show, and keep it until cancelled."""
        window = self._window
        if window is not None:
            while self._simulation is None:
                await asyncio.sleep(0.1)
            self.post(lambda: self._open_page(window, node))
        await node.closed.wait()
        return 0

    def close(self) -> None:
        """End the thread and everything on it."""
        self._ending.set()
        if self._thread is not None:
            self._thread.join(_END_S)

    # -- on its thread

    @property
    def simulation(self) -> Simulation:
        """The world as it is now."""
        assert self._simulation is not None, "open() comes first"
        return self._simulation

    @property
    def paused(self) -> bool:
        """Whether time stands still."""
        return self._paused

    def set_paused(self, paused: bool) -> None:
        """Stop time, or let it go on."""
        self._paused = paused
        self._pacer.restart()

    def spawn(self, xml: str, *, name: str, world_from_model: Pose, namespace: str) -> None:
        """Add a model."""
        if any(model.name == name for model in self.simulation.models):
            raise UsageError(f"SpawnModel: Failure - model name {name} already exist.")
        model = read_spawned(
            xml, name=name, namespace=namespace, folder=self._folder, packages=self._packages, report=self._report
        )
        model = replace(model, name=name, world_from_model=world_from_model @ model.world_from_model)
        self._change((*self._current(), model))

    def delete(self, name: str) -> None:
        """Remove a model."""
        self.simulation[name]
        self._arrivals.pop(name, None)
        self._change(tuple(model for model in self._current() if model.name != name))

    def place(self, name: str, world_from_model: Pose, joints: Mapping[str, float]) -> None:
        """Put a model somewhere, at rest."""
        handle = self.simulation[name]
        if world_from_model == handle.pose:
            for joint, position in joints.items():
                handle.joint(joint).set_position(position)
            return
        models = [replace(m, world_from_model=world_from_model) if m.name == name else m for m in self._current()]
        self._change(tuple(models), moved={name: dict(joints)})

    def reset(self, *, time: bool) -> None:
        """Put everything back to where it came."""
        models = tuple(
            replace(model, world_from_model=self._arrivals[model.name].world_from_model)
            for model in self.simulation.world.models
        )
        joints = {name: arrival.joints for name, arrival in self._arrivals.items()}
        self._change(models, moved=joints, time_ns=0 if time else None)

    # -- inside

    def _work(self) -> None:
        try:
            while not self._ending.is_set():
                self._drain()
                if self._simulation is None:
                    time.sleep(_IDLE_S)
                    continue
                if self._page is not None:
                    self._paused = self._page.obey(self._pacer, paused=self._paused)
                    self._page.feed(self._pacer, paused=self._paused)
                self._go_on(self._simulation)
        finally:
            if self._page is not None:
                self._page.close()

    def _go_on(self, simulation: Simulation) -> None:
        if self._paused:
            self._pacer.restart()
            simulation.advance(simulation.time_ns)
            self._ending.wait(_IDLE_S)
            return
        try:
            simulation.advance(self._pacer.next_target(simulation.time_ns))
        except SimulationUnstableError as error:
            self._paused = True
            self._say(f"{error}; the simulation is paused")
        self._clock.set(simulation.time_ns)

    def _drain(self) -> None:
        for _ in range(len(self._commands)):
            self._commands.popleft()()

    def _current(self) -> tuple[Model, ...]:
        """Every model where it is now."""
        return tuple(replace(handle.model, world_from_model=handle.pose) for handle in self.simulation.models)

    def _change(
        self,
        models: tuple[Model, ...],
        *,
        moved: Mapping[str, dict[str, float]] | None = None,
        time_ns: int | None = None,
    ) -> None:
        """Go on with other models, or with some elsewhere; those that stay keep their joints and come to rest."""
        old = self.simulation
        joints = {handle.name: _positions(handle) for handle in old.models}
        for name, positions in (moved or {}).items():
            joints.setdefault(name, {}).update(positions)
        world = replace(old.world, models=models)
        self._build(world, time_ns=old.time_ns if time_ns is None else time_ns, joints=joints)

    def _build(self, world: World, *, time_ns: int, joints: Mapping[str, Mapping[str, float]]) -> None:
        assert self._node is not None
        simulation = Simulation(world, self._report)
        simulation.steps = time_ns // simulation.step_ns
        for handle in simulation.models:
            for name, position in joints.get(handle.name, {}).items():
                handle.joint(name).set_position(position)
            arrival = _Arrival(world_from_model=handle.model.world_from_model, joints=_positions(handle))
            self._arrivals.setdefault(handle.name, arrival)
        clock = ClockTopic(self._node)
        simulation.add_hook(clock, period_ns=clock.period_ns, wanted=clock.wanted)
        self._cameras = mount_cameras(world, lambda: RayRenderer(scene_of(world, self._report)), self._report)
        for camera in self._cameras:
            simulation.add_hook(camera, period_ns=camera.period_ns, wanted=camera.wanted)
        self._forget_plugins()
        self._simulation = simulation
        self._clock.set(simulation.time_ns)
        load_plugins(simulation, self._make_node, self._env, say=self._say)
        if self._page is not None:
            self._page.replace(simulation, self._cameras)
        self._pacer.restart()

    def _forget_plugins(self) -> None:
        nodes, self._plugin_nodes = self._plugin_nodes, []
        for node in nodes:
            self._graph.loop.run(node.shutdown(), timeout_s=_CALL_S)

    def _make_node(self, name: str) -> Node:
        graph = self._graph
        node = Node(
            name, loop=graph.loop, master_uri=graph.master_uri, clock=self._clock, deliver=self.post, host=graph.host
        )
        self._plugin_nodes.append(node)
        return node

    def _open_page(self, window: tuple[str, int | None], node: Node) -> None:
        host, port = window
        try:
            self._page = Page.open(self.simulation, self._cameras, None, host=host, port=port)
        except TrundleError as error:
            node.log_error(str(error))
        else:
            self._say(f"see the simulation at {self._page.url}")


def _positions(handle: ModelHandle) -> dict[str, float]:
    """Where the joints are that can be put somewhere."""
    return {joint.name: joint.position for joint in handle.joints if joint.is_driven}
