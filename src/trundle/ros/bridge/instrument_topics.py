"""Topics of sensors other than cameras."""

from collections.abc import Iterable
from typing import Any, cast

from trundle.ros import Node, StaticTransformBroadcaster, Transform
from trundle.sim.sensors import AltimeterSensor, ContactSensor, ForceTorqueSensor, InstrumentSensor, SonarSensor
from trundle.spatial import Pose

from .frame_names import WORLD_FRAME, FrameNames, sensor_topic
from .sensor_topics import outputs_of

_TF = "tf2_msgs/TFMessage"
"""Message type with a header in each transform."""


def make_sensor_topics(
    node: Node, static_broadcaster: StaticTransformBroadcaster, sensors: Iterable[InstrumentSensor], names: FrameNames
) -> None:
    """Advertise the topics of sensors."""
    for sensor in sensors:
        InstrumentTopics(node, static_broadcaster, sensor, names)


class InstrumentTopics:
    """`<model>/<link>/<sensor>/imu`, `…/scan` and more by the sensor's type; messages are made only for subscribers."""

    def __init__(
        self, node: Node, static_broadcaster: StaticTransformBroadcaster, sensor: InstrumentSensor, names: FrameNames
    ) -> None:
        """Advertise, and send the sensor's frame."""
        self._frame = _send_frame(sensor, static_broadcaster, names)
        outputs = outputs_of(sensor)
        main = outputs[0].name
        self._topics = [
            (
                node.advertise(_output_topic(sensor, row.name, main=main), row.type, queue_size=row.queue_size),
                row.encoder(sensor),
                row.type == _TF,
            )
            for row in outputs
        ]
        sensor.topics = {topic.topic: topic.type for topic, _, _ in self._topics}
        sensor.listen(self._publish, enabled=lambda: any(topic.has_subscribers for topic, _, _ in self._topics))

    def _publish(self, reading: Any) -> None:
        header = {"stamp": reading.time_ns, "frame_id": self._frame}
        for topic, encode, has_inner_headers in self._topics:
            if not topic.has_subscribers:
                continue
            message = encode(reading)
            if has_inner_headers:
                transforms = cast("list[dict[str, object]]", message["transforms"])
                topic.publish({"transforms": [{**transform, "header": header} for transform in transforms]})
            else:
                topic.publish({**message, "header": header})


def _send_frame(sensor: InstrumentSensor, static_broadcaster: StaticTransformBroadcaster, names: FrameNames) -> str:
    """Broadcast the frame in which a sensor measures, unless it is a link's or the world's; return it."""
    match sensor:
        case AltimeterSensor() | ContactSensor():
            return WORLD_FRAME
        case ForceTorqueSensor():
            frame = _send_sensor_frame(sensor, sensor.link_from_sensor, static_broadcaster, names)
            parent = sensor.joint.parent
            return {
                "child": names.link(sensor.model, sensor.link.name),
                "parent": WORLD_FRAME if parent == "world" else names.link(sensor.model, parent),
            }.get(sensor.settings.frame, frame)
        case SonarSensor():  # the frame's x axis is along the beam
            return _send_sensor_frame(sensor, sensor.link_from_beam, static_broadcaster, names)
        case _:
            return _send_sensor_frame(sensor, sensor.sensor.link_from_sensor, static_broadcaster, names)


def _send_sensor_frame(
    sensor: InstrumentSensor, link_from_sensor: Pose, static_broadcaster: StaticTransformBroadcaster, names: FrameNames
) -> str:
    """Send the static transform of the sensor's frame on its link; return the frame."""
    frame = names.sensor(sensor.model, sensor.parent_name, sensor.sensor)
    parent = names.link(sensor.model, sensor.link.name)
    translation, rotation = link_from_sensor.position, link_from_sensor.quaternion
    static_broadcaster.send_transform(Transform(parent=parent, child=frame, translation=translation, rotation=rotation))
    return frame


def _output_topic(sensor: InstrumentSensor, output: str, *, main: str | None = None) -> str:
    """Topic of one of a sensor's outputs; see `sensor_topic`."""
    return sensor_topic(sensor.model, sensor.parent_name, sensor.sensor, output, main=main or output)
