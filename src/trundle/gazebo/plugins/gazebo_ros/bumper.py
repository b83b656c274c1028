"""libgazebo_ros_bumper.so: contacts of a link since the last message."""

from trundle.base.diagnostics import UsageError
from trundle.robots.parameters import TagParameters
from trundle.ros.bridge import contacts_message
from trundle.sim.sensors import ContactReading, ContactSensor, InstrumentSensor

from .plugin_names import PluginNames
from .sensor_publisher import SensorPublisher


def attach(sensor: InstrumentSensor, parameters: TagParameters, names: PluginNames) -> None:
    """Publish gazebo_msgs/ContactsState on <bumperTopicName> (bumper_states).

    As in the original, contacts are in world axes; <frameName> (world) only sets the header's frame.
    """
    if not isinstance(sensor, ContactSensor):
        raise UsageError(f"sensor {sensor.name!r} is of type {sensor.sensor.type}; a contact sensor is needed")
    topic = names.advertise("gazebo_msgs/ContactsState", parameters.text("bumperTopicName", "bumper_states"))
    frame = parameters.text("frameName", "world")
    if frame.strip("/") not in ("", "world", "map"):
        message = f"frameName {frame!r} is used in the header only: contacts are in world axes, as in gazebo_ros"
        parameters.report.info(parameters.at, message, "bumper-frame")
    publisher = SensorPublisher(topic, names.frame(frame))
    parameters.ignore("updateRate")

    def publish(reading: ContactReading) -> None:
        publisher.publish(reading, lambda: contacts_message(reading))

    sensor.listen(publish, enabled=publisher.has_subscribers)
