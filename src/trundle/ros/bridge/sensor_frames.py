"""Frames and topics of sensors."""

from trundle.ros import StaticTransformBroadcaster, Transform
from trundle.sim.sensors import InstrumentSensor
from trundle.spatial import Pose

from .frame_names import FrameNames, sensor_topic


def send_sensor_frame(
    sensor: InstrumentSensor, link_from_sensor: Pose, static_broadcaster: StaticTransformBroadcaster, names: FrameNames
) -> str:
    """Send the static transform of the sensor's frame on its link; return the frame."""
    frame = names.sensor(sensor.model, sensor.parent_name, sensor.sensor)
    carrier = names.link(sensor.model, sensor.link.name)
    place, turn = link_from_sensor.position, link_from_sensor.quaternion
    static_broadcaster.send_transform(Transform(parent=carrier, child=frame, translation=place, rotation=turn))
    return frame


def output_topic(sensor: InstrumentSensor, output: str, *, main: str | None = None) -> str:
    """Topic of one of a sensor's outputs; see `sensor_topic`."""
    return sensor_topic(sensor.model, sensor.parent_name, sensor.sensor, output, main=main or output)
