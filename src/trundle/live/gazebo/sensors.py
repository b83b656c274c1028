"""Sensors of the world behind /gazebo, and their topics, as models come and go."""

from trundle.robots.robot import Robot
from trundle.ros import Node, StaticTransformBroadcaster
from trundle.ros.bridge import FrameNames
from trundle.sim.renderers import RENDERERS, RendererName
from trundle.sim.sensors import CameraSensor, InstrumentSensor, RayScene, mount_cameras, mount_sensors
from trundle.sim.simulation import Simulation

from ..model_topics import ModelTopics


class GazeboSensors:
    """Sensors of one simulation; on its thread."""

    def __init__(self, simulation: Simulation, node: Node, renderer: RendererName) -> None:
        """Prepare; `mount` starts sensors."""
        self._simulation = simulation
        self._topics = ModelTopics(node, StaticTransformBroadcaster(node), simulation)
        self._renderer: RendererName = renderer
        self._around = RayScene(simulation)
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
        names = FrameNames.from_robot(robot) if robot is not None and len(self._robots) == 1 else FrameNames()
        self._topics.advertise(cameras, sensors, names)

    def robot(self, model: str) -> Robot | None:
        """Return the URDF that a model was spawned from."""
        return self._robots.get(model)

    def unmount(self, model: str) -> None:
        """Stop the sensors of a deleted model, and unregister its topics unless another model has them, too."""
        gone = [sensor for sensor in self.all if sensor.model.name == model]
        self.all = [sensor for sensor in self.all if sensor not in gone]
        for sensor in gone:
            sensor.stop(self._simulation)
        self._robots.pop(model, None)
        self._topics.unregister(model)
