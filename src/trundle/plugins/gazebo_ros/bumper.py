"""libgazebo_ros_bumper.so: what touched a link since the last message, where the plugin says."""

from trundle.bridge import contacts_message
from trundle.diagnostics import Diagnostics, UsageError
from trundle.model import PluginTag
from trundle.ros import Node
from trundle.sensors import ContactReading, ContactSensor, InstrumentSensor

from .namespaces import ignore, namespace_of
from .sensor import Outlet, topic_of


def attach(sensor: InstrumentSensor, node: Node, tag: PluginTag, report: Diagnostics) -> None:
    """Publish gazebo_msgs/ContactsState on <bumperTopicName> (bumper_states), in the world frame."""
    if not isinstance(sensor, ContactSensor):
        raise UsageError(f"sensor {sensor.name!r} is of type {sensor.sensor.type}; a contact sensor is needed")
    topic = topic_of(tag, namespace_of(tag, sensor.model.name), "bumperTopicName", "bumper_states")
    frame = tag.node.string("frameName", default="world").strip("/")
    if frame not in ("", "world", "map"):
        report.warn(tag.at, f"frameName {frame!r}: contacts are told in the world frame")
    outlet = Outlet(node, topic, "gazebo_msgs/ContactsState", "world")
    ignore(tag.node, "updateRate")
    tag.node.report_unread(report)

    def publish(reading: ContactReading) -> None:
        outlet.publish(reading, lambda: contacts_message(reading))

    sensor.listen(publish, enabled=outlet.wanted)
