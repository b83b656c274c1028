"""Topics of the sensors of each model, which end with it."""

from collections.abc import Sequence

from trundle.gazebo.model_plugins import attach_sensor_plugins
from trundle.ros import Endpoint, Node, StaticTransformBroadcaster
from trundle.ros.bridge import FrameNames, make_camera_topics, make_sensor_topics
from trundle.sim.sensors import CameraSensor, InstrumentSensor
from trundle.sim.simulation import Simulation


class ModelTopics:
    """Topics and services of the sensors of one simulation, by model, on one node."""

    def __init__(self, node: Node, static_broadcaster: StaticTransformBroadcaster, simulation: Simulation) -> None:
        """Prepare.

        Args:
            node: publishes the readings.
            static_broadcaster: of the node's /tf_static.
            simulation: of the sensors.
        """
        self._node = node
        self._static_broadcaster = static_broadcaster
        self._simulation = simulation
        self._endpoints: dict[str, list[Endpoint]] = {}

    def advertise(
        self, cameras: Sequence[CameraSensor], sensors: Sequence[InstrumentSensor], names: FrameNames
    ) -> None:
        """Advertise the topics of sensors, with frames of these names."""
        node, simulation = self._node, self._simulation
        for owner in dict.fromkeys(sensor.model.name for sensor in (*cameras, *sensors)):
            with node.endpoints.record() as self._endpoints[owner]:
                its_cameras = [camera for camera in cameras if camera.model.name == owner]
                its_sensors = [sensor for sensor in sensors if sensor.model.name == owner]
                silent_cameras = attach_sensor_plugins(its_cameras, node, simulation)
                make_camera_topics(node, self._static_broadcaster, silent_cameras, names)
                silent_sensors = attach_sensor_plugins(its_sensors, node, simulation)
                make_sensor_topics(node, self._static_broadcaster, silent_sensors, names)

    def unregister(self, model: str) -> None:
        """Unregister the topics of a deleted model unless another model has them, too."""
        ends = self._endpoints.pop(model, [])
        shared = {id(end) for others in self._endpoints.values() for end in others}
        for end in ends:
            if id(end) not in shared:
                end.unregister()
