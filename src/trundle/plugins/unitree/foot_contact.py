"""libunitreeFootContactPlugin.so: the force that the ground has on a foot."""

from trundle.diagnostics import Diagnostics, UsageError
from trundle.model import PluginTag
from trundle.ros import Node
from trundle.sensors import ContactReading, ContactSensor, InstrumentSensor
from trundle.spatial import Vector3

from ..gazebo_ros.namespaces import mark_read
from ..gazebo_ros.sensor_publisher import SensorPublisher


def attach(sensor: InstrumentSensor, node: Node, tag: PluginTag, report: Diagnostics) -> None:
    """Publish geometry_msgs/WrenchStamped on /visual/<sensor>/the_force, zero where nothing touches.

    It has no parameters. The force is in the axes of the sensor's link: the mean of the contacts since the message
    before, one for each step and collision touched. Of a contact's several points all count; the original takes the
    first as often as there are points, and calls that an error. Its header, empty there, has the time and the link.
    """
    if not isinstance(sensor, ContactSensor):
        raise UsageError(f"sensor {sensor.name!r} is of type {sensor.sensor.type}; a contact sensor is needed")
    outlet = SensorPublisher(node, f"/visual/{sensor.name}/the_force", "geometry_msgs/WrenchStamped", sensor.link.name)
    mark_read(tag.node)
    tag.node.report_unread(report)

    def message(reading: ContactReading) -> dict[str, object]:
        force = reading.world_from_link.inverse().transform_vector(_mean_force(reading))
        return {"wrench": {"force": dict(zip("xyz", force, strict=True))}}

    def publish(reading: ContactReading) -> None:
        outlet.publish(reading, lambda: message(reading))

    sensor.listen(publish, enabled=outlet.has_subscribers)


def _mean_force(reading: ContactReading) -> Vector3:
    """Of all contacts of a reading, world axes [N]."""
    contacts = len({(touch.time_ns, touch.own, touch.other) for touch in reading.contacts})
    if not contacts:
        return (0.0, 0.0, 0.0)
    x, y, z = (sum(each) / contacts for each in zip(*(t.wrench.force for t in reading.contacts), strict=True))
    return (x, y, z)
