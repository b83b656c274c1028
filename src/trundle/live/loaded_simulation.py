"""Result of `trundle.load`: a simulation with its sensors by name, its plugins and its ROS graph."""

from collections.abc import Callable, Mapping
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Self

from trundle.base.arguments import number_of
from trundle.base.diagnostics import Diagnostics, UsageError
from trundle.base.documented import documented
from trundle.robots.packages import Packages
from trundle.sim.realtime_pacer import STRIDE_FLAT_OUT_NS
from trundle.sim.simulation import Simulation
from trundle.spatial import NS_PER_S

from .world_setup import LoadedWorld, described_model

if TYPE_CHECKING:  # a simulation without a graph, or without use of its sensors, does not import these
    from numpy.typing import ArrayLike
    from PIL import Image

    from trundle.page.profile.stride_profile import StrideProfile
    from trundle.robots.description import Model
    from trundle.robots.model import Model as Description
    from trundle.ros import GraphLoop, Node
    from trundle.sim.physics import CompiledWorld
    from trundle.sim.sensors import CameraHandle, CameraImage, MountedSensors, RangeSensor, SensorHandle
    from trundle.sim.simulation import ModelHandle, Snapshot

    from .film import Film
    from .free_camera import FreeCamera
    from .live_world import LiveWorld
    from .plot import Plot
    from .recording import Recording
    from .run.ros_interface import RosInterface
    from .view import View

_BAG_PERIOD_NS = 10_000_000
"""Resolution of the stamps in bags [ns]."""


@documented(
    "camera camera_names sensor sensor_names profile view picture film record plot ros_master_uri make_node close"
)
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
        self._view: View | None = None
        self._recordings: list[Recording] = []

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
        """Lidar or ray sensor by name, for readings with another noise.

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
        """Live world with the sensors, plugins and topics of the models; made on first use."""
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

    def spawn(self, model: "Description | Model", *, allow_renaming: bool = False) -> "ModelHandle":
        """Add a model; everything else keeps its exact state.

        Args:
            model: model built in code, or the description of a simulated one, `ModelHandle.model`; added at its pose.
            allow_renaming: append _0, _1, … to a name that is taken, as Gazebo does.

        Raises:
            UsageError: the name is taken, or the argument is no model.
            DescriptionError: MuJoCo cannot simulate the result; nothing has changed.
        """
        return super().spawn(described_model(model, self.live.packages, self.report), allow_renaming=allow_renaming)

    # -- shown, drawn and recorded

    def view(self, *, speed: float | None = 1.0, host: str = "127.0.0.1", port: int | None = None) -> "View":
        """Open the page of the simulation, in the browser where a terminal has one, or in a notebook.

        It returns at once. `run` and `step` keep the page up to date, `View.sync` shows what was set since. A second
        call returns the open view.

        Args:
            speed: largest speed [simulated s per s]; None: as fast as possible.
            host: address to serve the page at; 0.0.0.0: any machine that reaches this one, with the link.
            port: TCP port; None: 8080 or the next free one.

        Raises:
            UsageError: the port is in use, or the speed is no number above zero.
        """
        from .view import View

        if self._view is None or not self._view.is_open:
            self._view = View(self.live, self._ros, speed=speed, host=host, port=port)
        return self._view

    def picture(
        self,
        eye: "ArrayLike | None" = None,
        target: "ArrayLike | None" = None,
        *,
        size: tuple[int, int] = (800, 600),
        fov_rad: float | None = None,
    ) -> "CameraImage":
        """Draw the present state from anywhere, with colors, depths and segmentation.

        Args:
            eye: position of the camera in the world (3) [m]; None: a three-quarter view of everything.
            target: point in the world in the middle of the picture (3) [m]; None: the origin.
            size: width and height [px].
            fov_rad: horizontal field of view [rad]; None: 0.9, or 0.6 for the three-quarter view.

        Raises:
            UsageError: a point is not 3 numbers, or the picture is too large.
        """
        return self._free_camera.draw(self.snapshot(), eye=eye, target=target, size=size, fov_rad=fov_rad)

    @cached_property
    def _free_camera(self) -> "FreeCamera":
        from .free_camera import FreeCamera

        return FreeCamera(self)

    def film(
        self,
        file: str | Path,
        *,
        camera: str | None = None,
        eye: "ArrayLike | None" = None,
        target: "ArrayLike | None" = None,
        size: tuple[int, int] = (800, 600),
        fov_rad: float | None = None,
    ) -> "Film":
        """Film the simulation from now on, 25 frames per simulated second, until the film is closed.

        Args:
            file: path: .mp4 (with the extra `video`), .webp, .gif or .apng.
            camera: name of a camera sensor, with its own size; None: a free camera, see `picture`.
            eye: position of the free camera in the world (3) [m].
            target: point in the world in the middle of the picture (3) [m].
            size: width and height [px].
            fov_rad: horizontal field of view [rad].

        Raises:
            UsageError: no such camera, or the file's name ends in something else.
        """
        from .film import Film

        seen_by = None if camera is None else self.camera(camera)

        def draw(snapshot: "Snapshot") -> "Image.Image":
            from PIL import Image

            if seen_by is not None:
                return Image.fromarray(seen_by.render().rgb)
            image = self._free_camera.draw(snapshot, eye=eye, target=target, size=size, fov_rad=fov_rad)
            return Image.fromarray(image.rgb)

        return Film(self, Path(file).expanduser(), draw)

    def record(self, file: str | Path) -> "Recording":
        """Record the simulation from now on, until the recording is closed.

        Args:
            file: path. .log: a state log, the poses of all links and positions of all joints fifty times a second, for
                `read_state_log` and `trundle play`. .bag, .mcap: every message that this process publishes, for a
                simulation with ROS.

        Raises:
            UsageError: the file's name ends in something else, it cannot be written, or there is no ROS graph.
        """
        from .recording import BagWriter, Recording, StateLogWriter

        path = Path(file).expanduser()
        match path.suffix.lower():
            case ".log":
                writer = StateLogWriter(self, path, self.world)
            case ".bag" | ".mcap":
                writer = BagWriter(self, path, self._graph.graph.loop)
            case _:
                raise UsageError(f"a recording's file ends in .log, .bag or .mcap, not in {path.suffix!r}")
        recording = Recording(path, writer, self._recordings.remove)
        self._recordings.append(recording)
        return recording

    def plot(self, *names: str, period_s: float = 0.02) -> "Plot":
        """Sample values while the simulation runs, as curves over time and as arrays.

        Args:
            names: `model::link.pose.z`, `model::link.twist.linear.x`, `model::joint.velocity`,
                `model::link.contact.force.z`, `model::link::sensor.…`, as in the page's plots; a model stands for its
                first link.
            period_s: time between two samples [s].

        Raises:
            UsageError: no such value; the message lists those of its link, joint or sensor.
        """
        from .plot import Plot

        period_ns = round(number_of(period_s, "period_s [s]", minimum=0.0) * NS_PER_S)
        self.live.start_sensors()
        return Plot(self.live, names, period_ns)

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
        view = self._view if self._view is not None and self._view.is_open else None
        if self._ros is None and view is None:
            super().advance(until_ns)
            return
        if self._ros is not None:
            self._ros.settle()
        stride_ns = STRIDE_FLAT_OUT_NS if view is None else view.stride_ns
        if self._ros is not None and self._recordings:
            stride_ns = min(stride_ns, _BAG_PERIOD_NS)
        strides, left_ns = 0, until_ns - self.time_ns
        while left_ns > 0:
            before_ns = self.simulated_ns
            super().advance(self.time_ns + min(left_ns, stride_ns))
            left_ns -= self.simulated_ns - before_ns
            strides += 1
            if self._ros is not None:
                self._ros.tick(wait=True)
                for recording in self._recordings:
                    recording.write()
            self._drain()
            if view is not None:
                view.follow()
        if view is not None and strides > 1:
            view.sync()

    def close(self) -> None:
        """Close its view, complete its recordings, and leave the ROS graph; stop its master if it was started here."""
        if self._view is not None:
            self._view.close()
        for recording in list(self._recordings):
            recording.close()
        ros, self._ros = self._ros, None
        if ros is not None:
            ros.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
