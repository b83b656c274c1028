"""Topics of the sensors of each model, which end with it."""

from collections.abc import Sequence

from trundle.bridge import FrameNames, make_camera_topics, make_sensor_topics
from trundle.diagnostics import Diagnostics
from trundle.ros import Endpoint, Node, StaticTransformBroadcaster
from trundle.sensors import CameraSensor, InstrumentSensor

from .plugins import attach_sensor_plugins


class ModelTopics:
    """Topics and services of the sensors of one simulation, by model, on one node."""

    def __init__(self, node: Node, static_broadcaster: StaticTransformBroadcaster, report: Diagnostics) -> None:
        """Prepare.

        Args:
            node: publishes the readings.
            static_broadcaster: of the node's /tf_static.
            report: takes findings on the sensors' plugins.
        """
        self._node = node
        self._static_broadcaster = static_broadcaster
        self._report = report
        self._endpoints: dict[str, list[Endpoint]] = {}

    def advertise(
        self, cameras: Sequence[CameraSensor], sensors: Sequence[InstrumentSensor], names: FrameNames
    ) -> None:
        """Advertise the topics of sensors, with frames of these names."""
        node, report = self._node, self._report
        for owner in dict.fromkeys(sensor.model.name for sensor in (*cameras, *sensors)):
            with node.endpoints.record() as self._endpoints[owner]:
                its_cameras = [camera for camera in cameras if camera.model.name == owner]
                its_sensors = [sensor for sensor in sensors if sensor.model.name == owner]
                silent_cameras = attach_sensor_plugins(its_cameras, node, report)
                make_camera_topics(node, self._static_broadcaster, silent_cameras, names)
                silent_sensors = attach_sensor_plugins(its_sensors, node, report)
                make_sensor_topics(node, self._static_broadcaster, silent_sensors, names)

    def unregister(self, model: str) -> None:
        """Unregister the topics of a deleted model unless another model has them, too."""
        ends = self._endpoints.pop(model, [])
        shared = {id(end) for others in self._endpoints.values() for end in others}
        for end in ends:
            if id(end) not in shared:
                end.unregister()
