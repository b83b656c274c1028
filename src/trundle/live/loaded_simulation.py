"""Result of `trundle.load`: a simulation with its sensors by name, its plugins and its ROS graph."""

import os
import warnings
from collections.abc import Callable, Mapping
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Self

from trundle.base.arguments import described
from trundle.base.diagnostics import Diagnostic, Diagnostics, TrundleWarning, UsageError
from trundle.robots.packages import Packages
from trundle.sim.realtime_pacer import STRIDE_FLAT_OUT_NS
from trundle.sim.simulation import Simulation

from .world_setup import LoadedWorld, load_built, load_world

if TYPE_CHECKING:  # a simulation without a graph, or without use of its sensors, does not import these
    from trundle.page.profile.stride_profile import StrideProfile
    from trundle.robots.description import Model, World
    from trundle.ros import GraphLoop, Node
    from trundle.sim.physics import CompiledWorld
    from trundle.sim.sensors import CameraHandle, MountedSensors, RangeSensor, SensorHandle

    from .live_world import LiveWorld
    from .run.ros_interface import RosInterface


class LoadedSimulation(Simulation):
    """A running world, with its sensors, plugins and ROS graph.

    If it is part of a ROS graph, `close` it, or use it in a `with` statement.
    """

    __module__ = "trundle"

    def __init__(
        self,
        loaded: LoadedWorld,
        report: Diagnostics,
        environment: Mapping[str, str],
        *,
        seed: int = 0,
        compiled: "CompiledWorld | None" = None,
    ) -> None:
        """Compile a world; time is zero.

        Args:
            loaded: world to compile.
            report: collects findings of physics.
            environment: environment variables that locate models and plugins; ROS_MASTER_URI names the master to join.
            seed: seed of all random numbers.
            compiled: the compiled world; None: compile it.
        """
        super().__init__(loaded.flat, report, seed=seed, compiled=compiled)
        self._loaded = loaded
        self._environment = environment
        self._ros: RosInterface | None = None

    def camera(self, name: str) -> "CameraHandle":
        """Camera by name.

        Args:
            name: `model::link::sensor`, as in Gazebo, or a unique end of it; of a multicamera: `sensor/camera`.

        Raises:
            UsageError: none or several; the message lists all names.
        """
        return self._sensors.camera(name)

    def sensor(self, name: str) -> "SensorHandle":
        """Sensor of any type by name.

        Args:
            name: `model::link::sensor`, as in Gazebo, or a unique end of it; of a joint: `model::joint::sensor`.

        Raises:
            UsageError: none or several; the message lists all names.
        """
        return self._sensors.sensor(name)

    def range_sensor(self, name: str) -> "RangeSensor":
        """Lidar or ray sensor by name, for readings with a different noise.

        Raises:
            UsageError: none or several, or of another type; the message lists all names.
        """
        return self._sensors.range_sensor(name)

    @property
    def camera_names(self) -> tuple[str, ...]:
        """`model::link::sensor` of each camera, in file order."""
        return self._sensors.camera_names()

    @property
    def sensor_names(self) -> tuple[str, ...]:
        """`model::link::sensor` of each sensor, cameras too; in file order."""
        return self._sensors.names()

    @cached_property
    def live(self) -> "LiveWorld":
        """Sensors, plugins and topics, which start and end with their models; made on first use."""
        from .live_world import LiveWorld

        packages = Packages(self._environment, start=Path.cwd())
        return LiveWorld(self, packages=packages, environment=self._environment, say=self._say)

    def _say(self, line: str) -> None:
        self.report.info(self.world.at, line)

    @property
    def _sensors(self) -> "MountedSensors":
        assert self.live.mounted is not None
        return self.live.mounted

    def profile(self) -> "StrideProfile":
        """Profiler of where wall time goes: `with sim.profile() as profile: sim.run(10)`, then `profile.read()`."""
        from trundle.page.profile.stride_profile import StrideProfile

        return StrideProfile(self, None if self._ros is None else self._ros.graph.loop)

    # -- the ROS graph

    def open_graph(self, *, on_open: "Callable[[GraphLoop], None]" = lambda _loop: None) -> None:
        """Advertise clock, frames, sensors and joints on a ROS graph, as `trundle run` does.

        Args:
            on_open: called with the loop of the graph, before anything is advertised.

        Raises:
            UsageError: the master of ROS_MASTER_URI does not answer.
        """
        from .run.ros_interface import RosInterface

        self.live.start_sensors()
        self._ros = RosInterface.open(self.live, self._loaded, self._environment, host="127.0.0.1", on_open=on_open)

    @property
    def ros_master_uri(self) -> str:
        """URI of its ROS master.

        Raises:
            UsageError: the simulation has no ROS graph.
        """
        return self._graph.graph.master_uri

    def make_node(self, name: str) -> "Node":
        """Make a node on simulation time; its callbacks run on this thread, between two steps.

        Raises:
            UsageError: the simulation has no ROS graph.
        """
        return self._graph.make_node(name)

    @property
    def _graph(self) -> "RosInterface":
        if self._ros is None:
            raise UsageError("the simulation is part of no ROS graph; load it with ros=True")
        return self._ros

    def load_plugins(self) -> None:
        """Load the plugins of the world and its models, and those of models spawned later; `report` lists them."""
        self.live.load_plugins()

    def advance(self, until_ns: int) -> None:
        """See `Simulation.advance`; messages reach the nodes of this process within 50 ms of simulation time."""
        if self._ros is None:
            super().advance(until_ns)
            return
        self._ros.settle()
        left_ns = until_ns - self.time_ns
        while left_ns > 0:
            before_ns = self.simulated_ns
            super().advance(self.time_ns + min(left_ns, STRIDE_FLAT_OUT_NS))
            left_ns -= self.simulated_ns - before_ns
            self._ros.tick(wait=True)
            self._drain()

    def close(self) -> None:
        """Leave the ROS graph; stop its master if it was started here."""
        ros, self._ros = self._ros, None
        if ros is not None:
            ros.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def load(
    file: "str | os.PathLike[str] | Model | World",
    *,
    seed: int = 0,
    plugins: bool = False,
    ros: bool | str = False,
    warn: bool = True,
) -> LoadedSimulation:
    """Load a robot or world, ready to simulate; a robot alone gets a ground plane and a sun.

    Args:
        file: SDF, URDF or xacro; a folder with model.config; model://NAME; or a `Model` or `World`.
        seed: seed of all random numbers.
        plugins: run the file's plugins, with ROS if `ros` is set; loaded plugins are listed in `report`.
        ros: join the ROS graph at ROS_MASTER_URI, or start a master if there is none; a master's URI joins its
            graph. `close` the simulation, or use it in a `with` statement.
        warn: print what is not simulated as written, as Python's warnings, each with file and line; False: only
            collect it in the simulation's `report`.

    Raises:
        TrundleError: one sentence with file and line.
    """
    if not isinstance(seed, int):
        raise UsageError(f"seed must be a whole number, got {described(seed)}")
    environment = dict(os.environ)
    if isinstance(ros, str):
        environment["ROS_MASTER_URI"] = ros
    report = _PrintedDiagnostics() if warn else Diagnostics()
    packages = Packages(environment, start=Path.cwd())
    if isinstance(file, str | os.PathLike):
        loaded = load_world(os.fspath(file), packages, report, seed=seed)
    elif hasattr(file, "to_sdf"):  # its classes are not imported for a file
        loaded = load_built(file, packages, report, seed=seed)
    else:
        raise UsageError(f"load needs a file's path, model://NAME, a Model or a World, got {described(file)}")
    simulation = LoadedSimulation(loaded, report, environment, seed=seed)
    try:
        if ros:
            simulation.open_graph()
        if plugins:
            simulation.load_plugins()
    except BaseException:
        simulation.close()
        raise
    return simulation


class _PrintedDiagnostics(Diagnostics):
    """Diagnostics whose warnings are also Python's, at the line of the file."""

    def _add(self, finding: Diagnostic) -> None:
        count = len(self.findings)
        super()._add(finding)
        if len(self.findings) > count and finding.severity == "warning":
            text, (file, line) = self.findings[-1].what, finding.at
            warnings.warn_explicit(text, TrundleWarning, file, line or 1, module="trundle")
