"""Sensors of the world behind /gazebo, and their topics, as models come and go."""

from trundle.bridge import FrameNames, make_camera_topics, make_sensor_topics
from trundle.diagnostics import Diagnostics
from trundle.robot import Robot
from trundle.ros import Endpoint, Node, StaticTransformBroadcaster
from trundle.sensors import CameraSensor, InstrumentSensor, RayScene, mount_cameras, mount_sensors
from trundle.simulation import Simulation

from ..plugins import attach_sensor_plugins
from ..renderers import RENDERERS, RendererName


class GazeboSensors:
    """Sensors of one simulation; on its thread."""

    def __init__(self, simulation: Simulation, node: Node, renderer: RendererName, report: Diagnostics) -> None:
        """Prepare; `mount` starts sensors."""
        self._simulation = simulation
        self._node = node
        self._static_broadcaster = StaticTransformBroadcaster(node)
        self._renderer: RendererName = renderer
        self._report = report
        self._around = RayScene(simulation)
        self._endpoints: dict[str, list[Endpoint]] = {}
        """Model → topics and services of its sensors."""
        self._robots: dict[str, Robot] = {}
        """Model → URDF that it was spawned from."""
        self.all: list[CameraSensor | InstrumentSensor] = []
        """All sensors, in the order in which they were mounted."""

    def mount(self, model: str | None = None, *, robot: Robot | None = None) -> None:
        """Start the sensors of all models, or of one that was spawned; those running go on.

        Args:
            model: the spawned one; None: all.
            robot: URDF that it came from. If it is the only one, the links' frames are robot_state_publisher's.
        """
        simulation = self._simulation
        if model is not None and robot is not None:
            self._robots[model] = robot
        beside = [sensor for sensor in self.all if isinstance(sensor, CameraSensor)]
        cameras = mount_cameras(simulation, RENDERERS[self._renderer], model=model, beside=beside)
        sensors = mount_sensors(simulation, model=model, ray_scene=self._around)
        for sensor in (*cameras, *sensors):
            sensor.start(simulation)
        self.all += [*cameras, *sensors]
        for owner in dict.fromkeys(sensor.model.name for sensor in (*cameras, *sensors)):
            with self._node.endpoints.record() as self._endpoints[owner]:
                self._advertise(
                    [camera for camera in cameras if camera.model.name == owner],
                    [sensor for sensor in sensors if sensor.model.name == owner],
                    FrameNames.from_robot(robot) if robot is not None and len(self._robots) == 1 else FrameNames(),
                )

    def unmount(self, model: str) -> None:
        """Stop the sensors of a deleted model, and unregister its topics unless another model has them, too."""
        gone = [sensor for sensor in self.all if sensor.model.name == model]
        self.all = [sensor for sensor in self.all if sensor not in gone]
        for sensor in gone:
            sensor.stop(self._simulation)
        self._robots.pop(model, None)
        ends = self._endpoints.pop(model, [])
        shared = {id(end) for others in self._endpoints.values() for end in others}
        for end in ends:
            if id(end) not in shared:
                end.unregister()

    def _advertise(self, cameras: list[CameraSensor], sensors: list[InstrumentSensor], names: FrameNames) -> None:
        make_camera_topics(
            self._node, self._static_broadcaster, attach_sensor_plugins(cameras, self._node, self._report), names
        )
        make_sensor_topics(
            self._node, self._static_broadcaster, attach_sensor_plugins(sensors, self._node, self._report), names
        )
