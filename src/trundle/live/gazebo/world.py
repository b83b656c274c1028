"""Simulation of a launch on its own thread: gzserver opens it, spawn_model adds models, gzclient shows it."""

import asyncio
import os
import time
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path

from trundle.base.diagnostics import Diagnostics, TrundleError, UsageError
from trundle.page.shared_page import SharedPage
from trundle.robots.description import LoadedDescription, load
from trundle.robots.model import World
from trundle.robots.packages import Packages
from trundle.ros import Node
from trundle.ros.bridge import clock_rate_hz
from trundle.sim.realtime_pacer import shorten_gil_interval
from trundle.sim.renderers import RendererName
from trundle.sim.sensors import CameraSensor, InstrumentSensor
from trundle.sim.simulation import Simulation
from trundle.spatial import Pose

from ..graph import Graph
from ..live_world import LiveWorld
from ..lockstep import Lockstep
from .contents import GazeboContents
from .gzclient_page import GzclientPage
from .simulation_thread import SimulationThread
from .stepper import IDLE_S, GazeboStepper
from .world_setup import WorldSetup

_POLL_S = 0.5
_EMPTY_WORLD = "worlds/empty.world"


class GazeboWorld:
    """Owner of one simulation; `trundle.gazebo.nodes.Simulator` states which thread may call what."""

    def __init__(
        self,
        *,
        graph: Graph,
        start: Path,
        env: Mapping[str, str],
        report: Diagnostics,
        folder: Path,
        say: Callable[[str], None],
        page: SharedPage | None,
        speed: float | None = 1.0,
        renderer: RendererName = "cpu",
        timeline_mb: int = 256,
        reload: Callable[[], None] | None = None,
        steps: Lockstep | None = None,
        setup: WorldSetup | None = None,
    ) -> None:
        """Prepare; `open` starts the simulation.

        Args:
            graph: ROS graph of its nodes.
            start: a file of the launch; packages are searched around it too.
            env: environment variables that locate packages, models and plugins.
            report: collects findings of files and physics.
            folder: folder for the text of each spawned model, whose lines messages name.
            say: prints a line.
            page: page of the graph's windows; None: headless.
            speed: real-time factor; None: flat out.
            renderer: draws the cameras' images.
            timeline_mb: memory of the timeline, with a page [MB]; 0: none.
            reload: requests, from any thread, to load the world again; None: not supported.
            steps: holds time until the nodes have settled; None: time never waits.
            setup: changes the world and its models; None: no changes.
        """
        self._setup = setup
        self._graph = graph
        self._start = start
        self._env = env
        self._report = report
        self._folder = folder
        self._say = say
        self._renderer: RendererName = renderer
        self._timeline_mb = timeline_mb
        self._request_reload = reload
        self._file = ""
        self._server_plugins: Sequence[str] = ()
        self._spawned: dict[str, Callable[[], None]] = {}
        """Spawned model → function that spawns it again."""
        self._respawns: list[Callable[[], None]] | None = None
        """Functions that spawn the models again in a reloaded world; None: the world opens for the first time."""
        self._window = GzclientPage(page, say, reload=None if reload is None else self._reload)
        self._thread = SimulationThread(graph.loop, self._tick, self._end)
        self._contents: GazeboContents | None = None
        self._stepper = GazeboStepper(graph.loop, self._thread, speed=speed, lockstep=steps, say=say)
        shorten_gil_interval()

    # -- any thread

    async def open(
        self,
        node: Node,
        world: str,
        *,
        paused: bool,
        env: Mapping[str, str],
        record: str | None = None,
        server_plugins: Sequence[str] = (),
    ) -> None:
        """Read a world; `begin` lets its time advance."""
        self._server_plugins = server_plugins
        with self._graph.loop.work.pending(f"the world {world}"):
            await self._open(node, world, paused=paused, env=env, record=record)

    async def _open(self, node: Node, name: str, *, paused: bool, env: Mapping[str, str], record: str | None) -> None:
        if self._thread.is_running:
            raise UsageError("a simulation is already running; a launch can have only one")
        self._env = {**self._env, **env}
        packages = Packages(self._env, start=self._start)
        self._stepper.paused = paused
        clock_hz = await clock_rate_hz(node)
        self._file = _find_world(name, packages, node)
        loaded = await asyncio.to_thread(self._read_world, packages, self._report)
        logs = None if record is None else Path(record).expanduser() if record else self._folder.parent / "gazebo"
        try:
            await self._thread.start(lambda: self._build(loaded.world, node, packages, clock_hz, logs))
        except BaseException:
            await asyncio.to_thread(self.close)
            raise
        if paused:
            self._say("the world is paused; /gazebo/unpause_physics starts it")

    def _read_world(self, packages: Packages, report: Diagnostics) -> LoadedDescription:
        loaded = load(self._file, report, packages=packages)
        if loaded.kind != "world":
            raise UsageError(f"{self._file} is a model; a world is needed")
        return loaded

    def begin(self) -> None:
        """Let time advance."""
        self._stepper.is_held = False

    def post(self, call: Callable[[], object]) -> None:
        """Queue a function for the simulation's thread, between two strides."""
        self._thread.calls.post(call)

    async def show(self, node: Node) -> int:
        """Open the page once a world is open, and keep it until cancelled."""
        while not node.closed.is_set():
            if self._window.is_pending and self._contents is not None:
                self.post(lambda: self._open_window(node))
            await asyncio.sleep(_POLL_S)
        return 0

    def close(self) -> None:
        """End the simulation and its thread; afterwards `open` may open another world."""
        if self._thread.stop() and self._contents is not None:
            self._contents.close_plugins()
            self._contents = None

    @property
    def is_open(self) -> bool:
        """True if a world is open."""
        return self._thread.is_running

    @property
    def is_ready(self) -> bool:
        """True if the open world has been built."""
        return self._contents is not None

    # -- on its thread

    @property
    def live(self) -> LiveWorld:
        """The running simulation, with its sensors and plugins."""
        assert self._contents is not None, "open() comes first"
        return self._contents.live

    @property
    def simulation(self) -> Simulation:
        """The running simulation."""
        return self.live.simulation

    @property
    def sensors(self) -> Sequence[CameraSensor | InstrumentSensor]:
        """Sensors of all models."""
        return self.live.sensors

    @property
    def is_lockstep(self) -> bool:
        """True if time waits for the nodes at each step."""
        return self._stepper.is_lockstep

    @property
    def paused(self) -> bool:
        """True if the simulation is paused."""
        return self._stepper.paused

    @property
    def stop_reason(self) -> str | None:
        """Reason why the simulation had to stop; None: it runs."""
        return self._stepper.stop_reason

    def set_paused(self, paused: bool) -> None:
        """Pause or resume."""
        self._stepper.set_paused(paused)

    def open_window(self, node: Node) -> str | None:
        """Open the page unless it is open; return its URL, or None if it cannot be served."""
        self._open_window(node)
        return self._window.url

    def spawn(self, xml: str, *, name: str, world_from_model: Pose, namespace: str) -> None:
        """Add a model."""
        assert self._contents is not None, "open() comes first"
        self._contents.spawn(xml, name=name, world_from_model=world_from_model, namespace=namespace)
        self._spawned[name] = partial(
            self.spawn, xml, name=name, world_from_model=world_from_model, namespace=namespace
        )
        self._stepper.pacer.restart()

    def delete(self, name: str) -> None:
        """Remove a model."""
        self.live.delete(name)
        self._spawned.pop(name, None)
        self._stepper.pacer.restart()

    def do(self, command: Callable[[Simulation], object]) -> None:
        """Run a command on the simulation; the timeline repeats it."""
        self.live.do(command)

    def set_speed(self, speed: float | None) -> None:
        """Set the real-time factor; None: flat out."""
        self._stepper.pacer.set_speed(speed)

    def reset(self, *, time: bool) -> None:
        """Put every model back to its initial state."""
        self.live.do(lambda simulation: simulation.reset(time=time))
        self._stepper.restart(self.simulation.time_ns)

    # -- inside

    def _reload(self) -> None:
        """Request to load the world again, if its file can be read.

        Raises:
            TrundleError: it cannot be read; the running world continues.
        """
        assert self._request_reload is not None
        self._read_world(self.live.packages, Diagnostics())
        self._request_reload()
        self._respawns = list(self._spawned.values())

    def _open_window(self, node: Node) -> None:
        if self._window.is_pending and self.live.timeline is None and self._timeline_mb and self._setup is None:
            self.live.keep_timeline(self._timeline_mb * 1_000_000)
        self._window.open(self.live, node)

    def _tick(self) -> None:
        """Handle the page's requests and step, once there is a simulation."""
        if self._contents is None:
            time.sleep(IDLE_S)
            return
        paused = self._stepper.paused or self._stepper.is_over
        self._stepper.paused = self._window.update(self._stepper.pacer, paused=paused)
        self._stepper.step(self._contents.live)

    def _end(self) -> None:
        self._window.close()
        if self._contents is not None:
            self._contents.close_logs()

    def _build(self, world: World, node: Node, packages: Packages, clock_hz: float | None, logs: Path | None) -> None:
        self._stepper.begin()
        self._contents = GazeboContents(
            world if self._setup is None else self._setup.world(world),
            node,
            graph=self._graph,
            packages=packages,
            env=self._env,
            folder=self._folder,
            report=self._report,
            renderer=self._renderer,
            clock_hz=clock_hz,
            post=self.post,
            say=self._say,
            setup=self._setup,
            is_lockstep=self._stepper.is_lockstep,
        )
        self._stepper.clock = self._contents.clock
        self._contents.load(logs, self._server_plugins)
        self._spawned.clear()
        respawns, self._respawns = self._respawns, None
        if respawns is not None:
            for spawn in respawns:
                try:
                    spawn()
                except TrundleError as error:
                    self._say(str(error))
            self._open_window(node)


def _find_world(world: str, packages: Packages, node: Node) -> str:
    """Find a world file; if there is none, log an error and return gzserver's empty world."""
    exists = world.startswith(("model://", "file://")) or os.path.exists(os.path.expanduser(world))
    if exists or packages.find_world(world) is not None:
        return world
    shipped = ", ".join(packages.worlds())
    node.log.error(
        f"{world}: no such world file; {_EMPTY_WORLD} is opened in its place, as gzserver does; worlds that come "
        f"with Trundle: {shipped}; others are searched along GAZEBO_RESOURCE_PATH"
    )
    return _EMPTY_WORLD
