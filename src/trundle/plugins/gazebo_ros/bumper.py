"""libgazebo_ros_bumper.so: contacts of a link since the last message."""

from trundle.bridge import contacts_message
from trundle.diagnostics import Diagnostics, UsageError
from trundle.model import PluginTag
from trundle.ros import Node
from trundle.sensors import ContactReading, ContactSensor, InstrumentSensor

from .namespaces import mark_read, read_namespace
from .sensor_publisher import SensorPublisher, read_topic_name


def attach(sensor: InstrumentSensor, node: Node, tag: PluginTag, report: Diagnostics) -> None:
    """Publish gazebo_msgs/ContactsState on <bumperTopicName> (bumper_states), in the world frame."""
    if not isinstance(sensor, ContactSensor):
        raise UsageError(f"sensor {sensor.name!r} is of type {sensor.sensor.type}; a contact sensor is needed")
    topic = read_topic_name(tag, read_namespace(tag, sensor.model.name), "bumperTopicName", "bumper_states")
    frame = tag.node.string("frameName", default="world").strip("/")
    if frame not in ("", "world", "map"):
        report.warn(tag.at, f"frameName {frame!r}: contacts are published in the world frame")
    outlet = SensorPublisher(node, topic, "gazebo_msgs/ContactsState", "world")
    mark_read(tag.node, "updateRate")
    tag.node.report_unread(report)

    def publish(reading: ContactReading) -> None:
        outlet.publish(reading, lambda: contacts_message(reading))

    sensor.listen(publish, enabled=outlet.has_subscribers)
