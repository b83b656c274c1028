"""libunitreeFootContactPlugin.so: contact force on a foot."""

from trundle.base.diagnostics import UsageError
from trundle.robots.parameters import TagParameters
from trundle.sim.sensors import ContactReading, ContactSensor, InstrumentSensor
from trundle.spatial import Vector3

from ..gazebo_ros.plugin_names import PluginNames
from ..gazebo_ros.sensor_publisher import SensorPublisher


def attach(sensor: InstrumentSensor, parameters: TagParameters, names: PluginNames) -> None:
    """Publish geometry_msgs/WrenchStamped on /visual/<sensor>/the_force, zero without contact.

    No parameters. The force, in the axes of the sensor's link, is the mean over the contacts since the last message,
    one per step and collision in contact. All points of a contact count; the original repeats the first point instead,
    which its source calls an error. The header has time and link; the original's is empty.
    """
    del parameters
    if not isinstance(sensor, ContactSensor):
        raise UsageError(f"sensor {sensor.name!r} is of type {sensor.sensor.type}; a contact sensor is needed")
    topic = names.advertise("geometry_msgs/WrenchStamped", f"/visual/{sensor.name}/the_force")
    publisher = SensorPublisher(topic, sensor.link.name)

    def message(reading: ContactReading) -> dict[str, object]:
        force = reading.world_from_link.inverse().transform_vector(_mean_force(reading))
        return {"wrench": {"force": dict(zip("xyz", force, strict=True))}}

    def publish(reading: ContactReading) -> None:
        publisher.publish(reading, lambda: message(reading))

    sensor.listen(publish, enabled=publisher.has_subscribers)


def _mean_force(reading: ContactReading) -> Vector3:
    """Mean force of a reading's contacts, world axes [N]."""
    count = len({(contact.time_ns, contact.collision, contact.other) for contact in reading.contacts})
    if not count:
        return (0.0, 0.0, 0.0)
    x, y, z = (
        sum(components) / count
        for components in zip(*(contact.wrench.force for contact in reading.contacts), strict=True)
    )
    return (x, y, z)
