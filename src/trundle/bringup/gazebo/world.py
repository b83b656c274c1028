"""Simulation of a launch: opened by gzserver, filled by spawn_model, shown by gzclient, on a thread of its own."""

import asyncio
import os
import threading
import time
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from msgspec.structs import replace

from trundle.bridge import ClockTopic, clock_rate_hz
from trundle.description import load
from trundle.diagnostics import Diagnostics, TrundleError, UsageError
from trundle.model import World
from trundle.packages import Packages
from trundle.page_address import PageAddress
from trundle.physics import SimulationUnstableError
from trundle.ros import Node, SimClock
from trundle.sensors import CameraSensor, InstrumentSensor
from trundle.simulation import Simulation
from trundle.spatial import Pose

from ..call_queue import CallQueue
from ..graph import Graph
from ..lockstep import Lockstep
from ..realtime_pacer import RealtimePacer, shorten_gil_interval
from ..renderers import RendererName
from ..state_logs import WorldRecorder
from .gzclient_page import GzclientPage
from .models import read_spawned
from .plugins import GazeboPlugins
from .sensors import GazeboSensors

_EMPTY_WORLD = "worlds/empty.world"
_IDLE_S = 0.01
_POLL_S = 0.5
_END_S = 2.0


class GazeboWorld:
    """Owner of one simulation; `trundle.nodes.Simulator` states which thread may call what."""

    def __init__(
        self,
        *,
        graph: Graph,
        start: Path,
        env: Mapping[str, str],
        report: Diagnostics,
        folder: Path,
        say: Callable[[str], None],
        window: PageAddress | None,
        speed: float | None = 1.0,
        renderer: RendererName = "cpu",
        steps: Lockstep | None = None,
    ) -> None:
        """Prepare; `open` starts the simulation.

        Args:
            graph: of its nodes.
            start: a file of the launch; packages are searched around it, too.
            env: variables that locate packages, models and plugins.
            report: takes findings of files and physics.
            folder: keeps the text of each spawned model; messages name its lines.
            say: prints a line.
            window: address of the page; None: headless.
            speed: times real time; None: flat out.
            renderer: draws the cameras' images.
            steps: holds time until the nodes are done; None: time is free.
        """
        self._graph = graph
        self._start = start
        self._env = env
        self._report = report
        self._folder = folder
        self._say = say
        self._window = GzclientPage(window, say)
        self._thread: threading.Thread | None = None
        self._calls = CallQueue(graph.loop)
        self._ending = threading.Event()
        self._simulation: Simulation | None = None
        self._renderer: RendererName = renderer
        self._lockstep = steps
        self._sensors: GazeboSensors | None = None
        self._plugins: GazeboPlugins | None = None
        self._clock = SimClock(graph.loop)
        self._clock_hz: float | None = None
        self._pacer = RealtimePacer(speed)
        shorten_gil_interval()
        self._record: Path | None = None
        self._recorder: WorldRecorder | None = None
        self._node: Node | None = None
        self._paused = False

    # -- any thread

    async def open(
        self, node: Node, world: str, *, paused: bool, env: Mapping[str, str], record: str | None = None
    ) -> None:
        """Read a world and start simulating it."""
        self._record = (
            None if record is None else Path(record).expanduser() if record else self._folder.parent / "gazebo"
        )
        with self._graph.loop.work.pending():
            await self._open(node, world, paused=paused, env=env)

    async def _open(self, node: Node, world: str, *, paused: bool, env: Mapping[str, str]) -> None:
        if self._thread is not None:
            raise UsageError("a simulation runs already; a launch has one")
        self._env = {**self._env, **env}
        self._packages = Packages(self._env, start=self._start)
        self._node, self._paused = node, paused
        self._clock_hz = await clock_rate_hz(node)
        loaded = await asyncio.to_thread(load, self._opened(world), self._report, packages=self._packages)
        if loaded.kind != "world":
            raise UsageError(f"{world} is a model; a world is needed")
        self._thread = threading.Thread(target=self._run, name="trundle-gazebo", daemon=True)
        built = asyncio.get_running_loop().create_future()

        def build() -> None:
            error = None
            try:
                self._build(loaded.world)
            except TrundleError as failure:
                error = failure
            self._graph.loop.call_soon(lambda: settle(error))

        def settle(error: TrundleError | None) -> None:
            if built.done():  # the launch ended meanwhile
                return
            if error is None:
                built.set_result(None)
            else:
                built.set_exception(error)

        self.post(build)
        self._thread.start()
        try:
            await built
        except BaseException:
            await asyncio.to_thread(self.close)
            raise
        if paused:
            self._say("the world is paused; /gazebo/unpause_physics starts it")

    def _opened(self, world: str) -> str:
        """The world asked for, or gzserver's empty one where there is no such file."""
        is_there = world.startswith(("model://", "file://")) or os.path.exists(os.path.expanduser(world))
        if is_there or self._packages.find_world(world) is not None:
            return world
        known = ", ".join(self._packages.worlds())
        assert self._node is not None
        self._node.log.error(
            f"{world}: no such world file; {_EMPTY_WORLD} is opened in its place, as gzserver does; worlds that come "
            f"with Trundle: {known}; others are searched along GAZEBO_RESOURCE_PATH"
        )
        return _EMPTY_WORLD

    def post(self, call: Callable[[], None]) -> None:
        """Queue a function for the simulation's thread, between two strides."""
        self._calls.post(call)

    async def show(self, node: Node) -> int:
        """Open the page once there is a world, and keep it until cancelled."""
        while not node.closed.is_set():
            if self._window.is_wanted and self._simulation is not None:
                self.post(lambda: self._window.open(self.simulation, self.sensors, node))
            await asyncio.sleep(_POLL_S)
        return 0

    def close(self) -> None:
        """End the thread and everything on it; afterwards a world may be opened again."""
        thread, self._thread = self._thread, None
        if thread is None:
            return
        self._ending.set()
        thread.join(_END_S)
        self._calls.clear()
        if self._plugins is not None:
            self._plugins.close()
        self._simulation = None
        self._ending.clear()

    @property
    def url(self) -> str | None:
        """URL of the page; None before it is served."""
        return self._window.url

    @property
    def is_over(self) -> bool:
        """True if there will be no page."""
        return self._window.is_over

    @property
    def is_open(self) -> bool:
        """True if a world is open."""
        return self._thread is not None

    # -- on its thread

    @property
    def simulation(self) -> Simulation:
        """The running simulation."""
        assert self._simulation is not None, "open() comes first"
        return self._simulation

    @property
    def sensors(self) -> Sequence[CameraSensor | InstrumentSensor]:
        """Sensors of all models."""
        return self._measuring.all

    @property
    def _measuring(self) -> GazeboSensors:
        assert self._sensors is not None, "open() comes first"
        return self._sensors

    @property
    def _loaded(self) -> GazeboPlugins:
        assert self._plugins is not None, "open() comes first"
        return self._plugins

    @property
    def is_lockstep(self) -> bool:
        """True if time waits for the nodes at each step."""
        return self._lockstep is not None

    @property
    def paused(self) -> bool:
        """True if the simulation is paused."""
        return self._paused

    def set_paused(self, paused: bool) -> None:
        """Pause, or go on."""
        self._paused = paused
        self._pacer.restart()

    def spawn(self, xml: str, *, name: str, world_from_model: Pose, namespace: str) -> None:
        """Add a model."""
        simulation = self.simulation
        if any(model.name == name for model in simulation.models):
            raise UsageError(f"Failure - model name {name} already exist.")
        model, robot = read_spawned(
            xml, name=name, namespace=namespace, folder=self._folder, packages=self._packages, report=self._report
        )
        pose = world_from_model @ model.world_from_model
        handle = simulation.spawn(replace(model, name=name, world_from_model=pose))
        self._measuring.mount(name, robot=robot)
        self._reload_page()
        self._loaded.load_model(handle)

    def delete(self, name: str) -> None:
        """Remove a model."""
        simulation = self.simulation
        simulation.delete(name)
        self._loaded.unload(name)
        self._measuring.unmount(name)
        self._reload_page()

    def edit(self, world: World) -> None:
        """Replace gravity, masses, limits or lights."""
        lights = self.simulation.world.lights
        self.simulation.edit(world)
        if world.lights != lights:
            self._reload_page()

    def set_speed(self, speed: float | None) -> None:
        """Set the real-time factor; None: flat out."""
        self._pacer.set_speed(speed)

    def reset(self, *, time: bool) -> None:
        """Put every model back to its initial state."""
        self.simulation.reset(time=time)
        self._clock.set(self.simulation.time_ns)
        self._pacer.restart()

    # -- inside

    def _run(self) -> None:
        if self._lockstep is not None:
            self._graph.loop.begin_batch()
        try:
            while not self._ending.is_set():
                self._calls.run_pending()
                if self._simulation is None:
                    time.sleep(_IDLE_S)
                    continue
                self._paused = self._window.update(self._pacer, paused=self._paused)
                self._step(self._simulation)
        finally:
            self._window.close()
            if self._recorder is not None:
                self._recorder.close()
                self._recorder = None

    def _step(self, simulation: Simulation) -> None:
        if self._paused or not (self._lockstep is None or self._lockstep.is_ready):
            self._pacer.restart()
            simulation.advance(simulation.time_ns)
            self._graph.loop.end_batch()
            self._ending.wait(_IDLE_S)
            return
        try:
            target_ns = self._pacer.next_target(simulation.time_ns)
            if self._lockstep is None:
                simulation.advance(target_ns)
            else:
                self._step_lockstep(simulation, self._lockstep, self._lockstep.target_ns(target_ns))
        except SimulationUnstableError as error:
            self._stop_stepping(str(error))
        except Exception as error:  # a plugin's code may raise anything
            self._stop_stepping(f"{type(error).__name__}: {error}")
        self._clock.set(simulation.time_ns)
        if self._lockstep is None and self._pacer.speed is None:
            self._graph.loop.flush_deliveries()  # delivery order does not depend on the machine's speed

    def _step_lockstep(self, simulation: Simulation, steps: Lockstep, until_ns: int) -> None:
        """Advance hook by hook, and wait after each until the nodes have settled."""
        end_ns = simulation.simulated_ns + until_ns - simulation.time_ns  # a node may have time reset amid this
        while (left_ns := end_ns - simulation.simulated_ns) > 0 and not self._paused and not self._ending.is_set():
            simulation.stride(simulation.time_ns + left_ns)
            self._clock.set(simulation.time_ns)
            steps.wait_settled(
                self._calls.run_pending, lambda: self._calls.has_pending() or self._ending.is_set(), self._ending.is_set
            )
            steps.record_step(simulation.time_ns)

    def _stop_stepping(self, why: str) -> None:
        self._paused = True
        self._say(f"{why}; the simulation is paused (/gazebo/unpause_physics tries to go on)")

    def _build(self, world: World) -> None:
        assert self._node is not None
        simulation = Simulation(world, self._report)
        ClockTopic(self._node, rate_hz=self._clock_hz).attach(simulation)
        self._simulation = simulation
        if self._record is not None:
            self._recorder = WorldRecorder(simulation, self._record, self._say)
            simulation.add_hook(self._recorder, period_ns=self._recorder.period_ns)
        self._sensors = GazeboSensors(simulation, self._node, self._renderer, self._report)
        self._sensors.mount()
        self._plugins = GazeboPlugins(
            simulation,
            self._node,
            graph=self._graph,
            env=self._env,
            clock=self._clock,
            deliver=self.post,
            say=self._say,
        )
        self._plugins.load()

    def _reload_page(self) -> None:
        self._window.reload(self.simulation, self.sensors)
        self._pacer.restart()
