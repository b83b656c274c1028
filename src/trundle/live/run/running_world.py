"""World of a run: its simulation with sensors, ROS interface, recording and plugins; it can be loaded again."""

from collections.abc import Callable, Mapping
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Self

from trundle.base.console import Console
from trundle.base.diagnostics import Diagnostics, UsageError
from trundle.base.files import is_stream
from trundle.base.garbage import no_garbage
from trundle.gazebo.model_plugins import load_plugins, load_world_plugins
from trundle.page.world_contents import has_sensors_or_plugins
from trundle.robots.model import Model
from trundle.robots.packages import Packages
from trundle.sim.renderers import RENDERERS
from trundle.sim.sensors import mount_cameras, mount_sensors
from trundle.sim.simulation import ModelHandle, Simulation

from ..world_setup import LoadedWorld, load_world
from .run_options import RunOptions

if TYPE_CHECKING:  # a run without a graph or a recording starts without their modules
    from trundle.gazebo.plugins import Plugin
    from trundle.robots.robot import Robot
    from trundle.sim.sensors import CameraSensor, InstrumentSensor
    from trundle.sim.timeline import Timeline

    from ..state_logs import RunRecorder
    from .ros_interface import RosInterface


class RunningWorld:
    """The world of a run, and all that measures, publishes or records it."""

    def __init__(
        self, file: str, options: RunOptions, environment: Mapping[str, str], report: Diagnostics, show: Console
    ) -> None:
        """Read and compile a description; `start` starts what belongs to it.

        Args:
            file: see `run`.
            options: of the run.
            environment: locates packages, plugins and the ROS master.
            report: takes all findings.
            show: prints them.

        Raises:
            TrundleError: the file is invalid.
        """
        self._file = file
        self._options = options
        self.environment = environment
        self._report = report
        self._show = show
        self._open_things = ExitStack()
        self.cameras: list[CameraSensor] = []
        self.sensors: list[InstrumentSensor] = []
        self.ros: RosInterface | None = None
        self.recorder: RunRecorder | None = None
        self.timeline: Timeline | None = None
        self.on_sensors: Callable[[], None] | None = None
        """Called after sensors came or went with a model."""
        self.stage, self.simulation = self._read()

    def _read(self) -> tuple[LoadedWorld, Simulation]:
        options = self._options
        with no_garbage():
            self.packages = Packages(self.environment, start=Path.cwd())
            stage = load_world(self._file, self.packages, self._report, seed=options.seed)
            return stage, Simulation(stage.world, self._report, seed=options.seed)

    def start(self) -> None:
        """Start sensors, the ROS interface, recording and plugins.

        Raises:
            TrundleError: the graph cannot be joined, or the recording not be written.
        """
        self._mount_sensors()
        self._show.findings()
        if self._options.ros:
            self._open_graph()
        if self._options.record is not None:
            self._record(self._options.record)
        self._load_plugins()

    def reload(self) -> None:
        """Read the file again, and simulate it from its beginning.

        Raises:
            TrundleError: that cannot be done; the world that runs goes on.
        """
        if self.recorder is not None:
            raise UsageError("the recording of this run has one world: start it without --record to load others")
        if is_stream(self._file):
            raise UsageError("the world came through a pipe, which cannot be read again")
        self.stage, self.simulation = self._read()
        self._mount_sensors()
        if self.ros is not None:
            self.ros = self.ros.replaced(self.simulation, self.stage, self.cameras, self.sensors)
        self._load_plugins()

    def _mount_sensors(self) -> None:
        simulation, options = self.simulation, self._options
        self.cameras = mount_cameras(simulation, RENDERERS[options.renderer])
        self.sensors = mount_sensors(simulation)
        if not options.sensors:
            self.cameras.clear()
            self.sensors.clear()
        for sensor in (*self.cameras, *self.sensors):
            sensor.start(simulation)

    def _open_graph(self) -> None:
        from .ros_interface import RosInterface

        self.ros = RosInterface.open(
            self.simulation, self.stage, self.cameras, self.sensors, self.environment, host=self._options.host
        )
        self._open_things.callback(lambda: self.ros is None or self.ros.close())
        if self.ros.graph.core is not None:
            self._show.line(self.ros.graph.summary)

    def _record(self, file: Path) -> None:
        from ..state_logs import RunRecorder, start_state_log

        log = start_state_log(file, self.simulation, self.stage.written, self._report)
        recorder = self.recorder = RunRecorder(log, self._show.line)
        self.simulation.add_hook(recorder, period_ns=recorder.period_ns)
        self._open_things.callback(recorder.close)

    def _load_plugins(self) -> None:
        self._plugins = {model.name: self._plugins_of(model) for model in self.simulation.models}
        make_node = None if self.ros is None else self.ros.plugin_nodes.maker("")
        load_world_plugins(self.simulation, make_node, self.environment, say=self._show.line)
        self._show.findings()
        if self._options.timeline_mb and not self._options.headless:
            from trundle.sim.timeline import Timeline

            limit_bytes = self._options.timeline_mb * 1_000_000
            self.timeline = Timeline(self.simulation, roots=self._roots, limit_bytes=limit_bytes)

    def _plugins_of(self, model: ModelHandle) -> "list[Plugin]":
        """Load the plugins of a model."""
        make_node = None if self.ros is None else self.ros.plugin_nodes.maker(model.name)
        return load_plugins(self.simulation, make_node, self.environment, say=self._show.line, models=[model])

    @property
    def _roots(self) -> "list[Plugin]":
        """Plugins with a state that the timeline saves."""
        return [plugin for plugins in self._plugins.values() for plugin in plugins]

    def robot(self, model: str) -> "Robot | None":
        """Return None: joint states and the description are those of the robot that the run began with."""
        del model

    def spawn(self, model: Model, robot: "Robot | None") -> None:
        """Add a model with its sensors and plugins; with those, the timeline begins again.

        Raises:
            TrundleError: MuJoCo cannot simulate it; nothing has changed.
        """
        del robot
        if self.timeline is not None and not has_sensors_or_plugins(model):
            self.timeline.do(lambda sim: sim.spawn(model))
            return
        handle = self.simulation.spawn(model)
        if self._options.sensors:
            self._mount_sensors_of(model.name)
        self._plugins[model.name] = self._plugins_of(handle)
        self._show.findings()
        if self.timeline is not None:
            self.timeline.restart(self._roots)

    def _mount_sensors_of(self, model: str) -> None:
        simulation = self.simulation
        renderer = RENDERERS[self._options.renderer]
        cameras = mount_cameras(simulation, renderer, model=model, beside=self.cameras)
        sensors = mount_sensors(simulation, model=model)
        for sensor in (*cameras, *sensors):
            sensor.start(simulation)
        if self.ros is not None:
            self.ros.advertise(cameras, sensors)
        self.cameras += cameras
        self.sensors += sensors
        if self.on_sensors is not None:
            self.on_sensors()

    def delete(self, name: str) -> None:
        """Remove a model with its sensors and plugins; if it has any, the timeline begins again.

        Raises:
            UsageError: no such model; the message lists the models there are.
        """
        simulation = self.simulation
        if self.timeline is not None and not has_sensors_or_plugins(simulation[name].model):
            self.timeline.do(lambda sim: sim.delete(name))
            return
        simulation.delete(name)
        for sensor in (*self.cameras, *self.sensors):
            if sensor.model.name == name:
                sensor.stop(simulation)
        self.cameras = [camera for camera in self.cameras if camera.model.name != name]
        self.sensors = [sensor for sensor in self.sensors if sensor.model.name != name]
        for plugin in self._plugins.pop(name, []):
            simulation.remove_hook(plugin)
        if self.ros is not None:
            self.ros.unload(name)
        if self.on_sensors is not None:
            self.on_sensors()
        if self.timeline is not None:
            self.timeline.restart(self._roots)

    def advance(self, until_ns: int) -> None:
        """Simulate up to a time [ns]; see `Simulation.advance`."""
        if self.timeline is None:
            self.simulation.advance(until_ns)
        else:
            self.timeline.advance(until_ns)

    def close(self) -> None:
        """End everything that was started."""
        self._open_things.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
