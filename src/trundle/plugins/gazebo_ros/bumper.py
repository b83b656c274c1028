"""libgazebo_ros_bumper.so: contacts of a link since the last message."""

from trundle.bridge import contacts_message
from trundle.diagnostics import UsageError
from trundle.parameters import TagParameters
from trundle.ros import Node
from trundle.sensors import ContactReading, ContactSensor, InstrumentSensor

from .namespaces import read_namespace
from .sensor_publisher import SensorPublisher, read_topic_name


def attach(sensor: InstrumentSensor, node: Node, parameters: TagParameters) -> None:
    """Publish gazebo_msgs/ContactsState on <bumperTopicName> (bumper_states), in the world frame."""
    if not isinstance(sensor, ContactSensor):
        raise UsageError(f"sensor {sensor.name!r} is of type {sensor.sensor.type}; a contact sensor is needed")
    topic = read_topic_name(
        parameters, read_namespace(parameters, sensor.model.name), "bumperTopicName", "bumper_states"
    )
    frame = parameters.text("frameName", "world").strip("/")
    if frame not in ("", "world", "map"):
        parameters.warn(f"frameName {frame!r}: contacts are published in the world frame")
    outlet = SensorPublisher(node, topic, "gazebo_msgs/ContactsState", "world")
    parameters.ignore("updateRate")

    def publish(reading: ContactReading) -> None:
        outlet.publish(reading, lambda: contacts_message(reading))

    sensor.listen(publish, enabled=outlet.has_subscribers)
