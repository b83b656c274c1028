"""Models of the world behind /gazebo, with their sensors and plugins, as they come and go."""

from collections.abc import Callable, Mapping
from pathlib import Path

from msgspec.structs import replace

from trundle.base.diagnostics import Diagnostics, UsageError
from trundle.robots.model import Model, World
from trundle.robots.packages import Packages
from trundle.robots.robot import Robot
from trundle.ros import Clock, Deliver, Node
from trundle.ros.bridge import ClockTopic
from trundle.sim.physics import BackgroundCutting
from trundle.sim.renderers import RendererName
from trundle.sim.sensors import CameraSensor, InstrumentSensor
from trundle.sim.simulation import Simulation
from trundle.spatial import Pose

from ..graph import Graph
from ..state_logs import WorldRecorder
from .models import read_spawned
from .plugins import GazeboPlugins
from .sensors import GazeboSensors
from .world_setup import WorldSetup


class GazeboContents:
    """One simulation and everything on it; on its thread."""

    def __init__(
        self,
        world: World,
        node: Node,
        *,
        graph: Graph,
        packages: Packages,
        env: Mapping[str, str],
        folder: Path,
        report: Diagnostics,
        renderer: RendererName,
        clock: Clock,
        clock_hz: float | None,
        deliver: Deliver,
        say: Callable[[str], None],
        setup: WorldSetup | None,
        is_lockstep: bool,
    ) -> None:
        """Compile the world; `load` starts what is on it.

        Args:
            world: as read.
            node: gzserver's.
            graph: of the plugins' nodes.
            packages: locates what spawned models name.
            env: variables that locate plugins.
            folder: keeps the text of each spawned model.
            report: takes findings of spawned models and physics.
            renderer: draws the cameras' images.
            clock: time of the plugins' nodes.
            clock_hz: rate of /clock; None: the usual one.
            deliver: runs the plugins' callbacks on this thread.
            say: prints which plugins are loaded, and where logs are.
            setup: seeds the simulation, begins with it, changes spawned models; None: they are spawned as read.
            is_lockstep: hollow meshes are cut before time goes on, so that runs repeat; else in the background.
        """
        self.packages, self.environment = packages, env
        self._folder, self._report, self._say = folder, report, say
        self._cutting = (
            None if is_lockstep else BackgroundCutting(say, lambda count: deliver(lambda: self._use_cuts(count)))
        )
        seed = 0 if setup is None else setup.seed
        self.simulation = Simulation(world, report, seed=seed, cutting=self._cutting)
        self._setup = setup
        if setup is not None:
            setup.start(self.simulation, node)
        ClockTopic(node, rate_hz=clock_hz).attach(self.simulation)
        self._sensors = GazeboSensors(self.simulation, node, renderer)
        self._plugins = GazeboPlugins(
            self.simulation, node, graph=graph, env=env, clock=clock, deliver=deliver, say=say
        )
        self._recorder: WorldRecorder | None = None

    @property
    def sensors(self) -> list[CameraSensor | InstrumentSensor]:
        """Sensors of all models."""
        return self._sensors.all

    def load(self, record: Path | None) -> None:
        """Start state logs in a folder (None: without), sensors and plugins."""
        if record is not None:
            self._recorder = WorldRecorder(self.simulation, record, self._say)
            self.simulation.add_hook(self._recorder, period_ns=self._recorder.period_ns)
        self._sensors.mount()
        self._plugins.load()

    def spawn(self, xml: str, *, name: str, world_from_model: Pose, namespace: str) -> None:
        """Add a model with its sensors and plugins."""
        if any(model.name == name for model in self.simulation.models):
            raise UsageError(f"Failure - model name {name} already exist.")
        model, robot = read_spawned(
            xml, name=name, namespace=namespace, folder=self._folder, packages=self.packages, report=self._report
        )
        pose = world_from_model @ model.world_from_model
        self.insert(replace(model, name=name, world_from_model=pose), robot)

    def insert(self, model: Model, robot: Robot | None) -> None:
        """Add a model, already read, with its sensors."""
        if self._setup is not None:
            model = self._setup.model(model)
        self.simulation.spawn(model)
        self._sensors.mount(model.name, robot=robot)

    def _use_cuts(self, count: int) -> None:
        """Replace the hulls that stood in for hollow meshes."""
        self.simulation.recompile()
        if count:
            self._say(f"{count} hollow meshes are cut, and collide as their convex pieces from now on")

    def robot(self, model: str) -> Robot | None:
        """Return the URDF that a model was spawned from."""
        return self._sensors.robot(model)

    def load_plugins(self, name: str) -> None:
        """Load the plugins of a spawned model."""
        self._plugins.load_model(self.simulation[name])

    def delete(self, name: str) -> None:
        """Remove a model with its sensors and plugins."""
        self.simulation.delete(name)
        self._plugins.unload(name)
        self._sensors.unmount(name)

    def close_logs(self) -> None:
        """Complete the state logs."""
        if self._recorder is not None:
            self._recorder.close()
            self._recorder = None

    def close_plugins(self) -> None:
        """Shut down the plugins' nodes without waiting, and cut no more meshes; from any thread."""
        if self._cutting is not None:
            self._cutting.close()
        self._plugins.close()
