"""A running world whose models are spawned and deleted with their sensors, plugins, topics and nodes."""

from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING

from trundle.gazebo.model_plugins import load_plugins, load_server_plugins, load_world_plugins
from trundle.page.shown_world import has_sensors_or_plugins
from trundle.robots.packages import Packages
from trundle.sim.simulation import ModelHandle, Simulation

if TYPE_CHECKING:  # a world without a graph, a timeline or plugins starts without their modules
    from trundle.gazebo.plugins import Plugin
    from trundle.robots.model import Model
    from trundle.robots.robot import Robot
    from trundle.sim.renderers import RendererName
    from trundle.sim.sensors import CameraSensor, InstrumentSensor, MountedSensors
    from trundle.sim.timeline import Timeline

    from .model_interfaces import ModelInterfaces


class LiveWorld:
    """One simulation, with the sensors, plugins, topics and nodes of its models.

    These parts start and end with their model, whoever spawns and deletes it: the page, a service, a plugin, a program.
    A live world belongs to the simulation's thread.
    """

    def __init__(
        self,
        simulation: Simulation,
        *,
        packages: Packages,
        environment: Mapping[str, str],
        say: Callable[[str], None],
        renderer: "RendererName" = "cpu",
        has_sensors: bool = True,
    ) -> None:
        """Follow spawns and deletions; `start_sensors`, `load_plugins` and `keep_timeline` start the other parts.

        Args:
            simulation: running simulation.
            packages: finds models.
            environment: environment variables that locate plugins.
            say: prints which plugins are loaded.
            renderer: draws the cameras' images.
            has_sensors: False: no sensor measures.
        """
        self.simulation = simulation
        self.packages = packages
        self.environment = environment
        self.timeline: Timeline | None = None
        """Last minutes of the simulation; None: not recorded."""
        self.on_parts: Callable[[], None] = lambda: None
        """Called after sensors or plugins started or ended with a model."""
        self._say = say
        self._renderer: RendererName = renderer
        self._has_sensors = has_sensors
        self._interfaces: ModelInterfaces | None = None
        self._spawning_robot: Robot | None = None
        """URDF of the model that is being spawned."""
        self._robots: dict[ModelHandle, Robot] = {}
        self._plugins: dict[ModelHandle, list[Plugin]] = {}
        self._followed = list(simulation.models)
        self._timeline_changes: int = 0
        """`_interface_changes` when the timeline began."""
        self._starts_sensors = self._loads_plugins = self._is_timeline_due = False
        simulation.on_change(self._follow_models)

    @cached_property
    def mounted(self) -> "MountedSensors | None":
        """Sensors by name, mounted on first use; None: no sensor measures."""
        from trundle.sim.renderers import RENDERERS
        from trundle.sim.sensors import MountedSensors

        return MountedSensors(self.simulation, RENDERERS[self._renderer]) if self._has_sensors else None

    @property
    def sensors(self) -> "list[CameraSensor | InstrumentSensor]":
        """Sensors of all models."""
        return [] if self.mounted is None else [*self.mounted.cameras, *self.mounted.instruments]

    @property
    def image_count(self) -> int:
        """Number of rendered camera images."""
        return 0 if self.mounted is None else sum(camera.image_count for camera in self.mounted.cameras)

    def robot(self, model: str) -> "Robot | None":
        """Return the URDF that a model was spawned from."""
        return next((robot for handle, robot in self._robots.items() if handle.name == model), None)

    # -- parts

    def start_sensors(self) -> None:
        """Start all sensors, and from now on those of spawned models; each measures while it has subscribers."""
        self._starts_sensors = True
        if self.mounted is not None:
            self.mounted.start()

    def join_graph(self, interfaces: "ModelInterfaces") -> None:
        """Advertise the sensors' topics, and make a node for each plugin loaded later."""
        self._interfaces = interfaces
        for model in self.simulation.models:
            self._advertise(model)

    def load_plugins(self, server_plugins: Sequence[str] = ()) -> None:
        """Load the plugins of the world and of its models, and from now on those of spawned models.

        Args:
            server_plugins: libraries of plugins of the system, which are loaded before the others.
        """
        self._loads_plugins = True
        make_world_node = None if self._interfaces is None else self._interfaces.node_maker(None)
        load_server_plugins(self.simulation, server_plugins, make_world_node, self.environment, log=self._say)
        for model in self.simulation.models:
            self._load_plugins_of(model)
        load_world_plugins(self.simulation, make_world_node, self.environment, log=self._say)

    def keep_timeline(self, limit_bytes: int) -> None:
        """Record the last minutes, for seeking; `limit_bytes` is the memory of the saved states."""
        from trundle.sim.timeline import Timeline

        self.timeline = Timeline(self.simulation, roots=self._plugin_list, limit_bytes=limit_bytes)
        self._timeline_changes = self._interface_changes

    # -- commands

    def advance(self, until_ns: int, simulate: Callable[[int], None] | None = None) -> None:
        """Simulate up to a time [ns]; see `Simulation.advance`.

        Args:
            until_ns: time [ns].
            simulate: simulates up to a time [ns]; None: `Simulation.advance`.
        """
        simulate = simulate or self.simulation.advance
        if self.timeline is None:
            simulate(until_ns)
        else:
            self._restart_timeline_if_due()
            self.timeline.advance(until_ns, simulate)

    def do(self, command: Callable[[Simulation], object]) -> None:
        """Run a command on the simulation; the timeline repeats it.

        Raises:
            TrundleError: the command raised it.
        """
        if self.timeline is None:
            command(self.simulation)
        else:
            self._restart_timeline_if_due()
            self.timeline.do(command)

    def spawn(self, model: "Model", robot: "Robot | None" = None) -> None:
        """Add a model; if it has sensors or plugins, the timeline restarts.

        Args:
            model: model to add at its pose.
            robot: URDF from which the model was read.

        Raises:
            TrundleError: the name is in use, or MuJoCo cannot simulate it; nothing has changed.
        """
        self._spawning_robot = robot
        try:
            self._do_or_restart(model, lambda simulation: simulation.spawn(model))
        finally:
            self._spawning_robot = None

    def delete(self, name: str) -> None:
        """Delete a model; if it has sensors or plugins, the timeline restarts.

        Raises:
            UsageError: no such model; the message lists all models.
        """
        self._do_or_restart(self.simulation[name].model, lambda simulation: simulation.delete(name))

    def close(self) -> None:
        """Shut down the plugins' nodes without waiting; from any thread."""
        if self._interfaces is not None:
            self._interfaces.close()

    # -- inside

    def _do_or_restart(self, model: "Model", command: Callable[[Simulation], object]) -> None:
        """Run a command that the timeline repeats; restart the timeline instead if the model has sensors or plugins."""
        if has_sensors_or_plugins(model):
            command(self.simulation)
            self._restart_timeline_if_due()
        else:
            self.do(command)

    def _restart_timeline_if_due(self) -> None:
        """Restart the timeline after sensors, plugins or topics of a plugin's controller were added or removed."""
        changes = self._interface_changes
        if self.timeline is not None and (self._is_timeline_due or changes != self._timeline_changes):
            self.timeline.restart(self._plugin_list)
        self._is_timeline_due, self._timeline_changes = False, changes

    @property
    def _interface_changes(self) -> int:
        return 0 if self._interfaces is None else self._interfaces.changes

    @property
    def _plugin_list(self) -> "list[Plugin]":
        return [plugin for plugins in self._plugins.values() for plugin in plugins]

    def _follow_models(self) -> None:
        """Start sensors, topics and plugins of spawned models, and end those of deleted ones."""
        followed, models = self._followed, self.simulation.models
        self._followed = list(models)
        old_ids, new_ids = set(map(id, followed)), set(map(id, models))
        spawned = [model for model in models if id(model) not in old_ids]
        deleted = [model for model in followed if id(model) not in new_ids]
        if not spawned and not deleted:
            return
        changes_parts = any(has_sensors_or_plugins(model.model) for model in (*spawned, *deleted))
        self._is_timeline_due |= changes_parts
        if self._starts_sensors and self.mounted is not None:
            self.mounted.update()
            self.mounted.start()
        for model in deleted:
            self._unload(model)
        if self._spawning_robot is not None:
            self._robots[spawned[0]] = self._spawning_robot
        for model in spawned:
            self._advertise(model)
            if self._loads_plugins:
                self._load_plugins_of(model)
        if changes_parts:
            self.on_parts()

    def _advertise(self, model: ModelHandle) -> None:
        if self._interfaces is not None and self.mounted is not None:
            lone_robot = self._robots.get(model) if len(self._robots) == 1 else None
            self._interfaces.advertise(model, *self.mounted.of_model(model), lone_robot, self.environment)

    def _load_plugins_of(self, model: ModelHandle) -> None:
        make_node = None if self._interfaces is None else self._interfaces.node_maker(model)
        plugins = load_plugins(self.simulation, make_node, self.environment, log=self._say, models=[model])
        if plugins:
            self._plugins[model] = plugins

    def _unload(self, model: ModelHandle) -> None:
        self._robots.pop(model, None)
        for plugin in self._plugins.pop(model, []):
            self.simulation.remove_hook(plugin)
        if self._interfaces is not None:
            self._interfaces.unload(model)
