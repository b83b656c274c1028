"""libgazebo_ros_laser.so, libgazebo_ros_gpu_laser.so and libgazebo_ros_ray_sensor.so: scans of a ray sensor."""

import re

from trundle.base.diagnostics import UsageError
from trundle.robots.parameters import TagParameters
from trundle.ros.bridge import points_message, scan_message
from trundle.sim.sensors import InstrumentSensor, RangeReading, RangeSensor

from .namespaces import join_topic
from .plugin_names import PluginNames, TopicPublisher
from .sensor_publisher import SensorPublisher

_TOPIC = "/world"


def attach(sensor: InstrumentSensor, parameters: TagParameters, names: PluginNames) -> None:
    """Publish sensor_msgs/LaserScan on <topicName> (without it scan and, as in the original, /world) in <frameName>
    /world.
    """
    rays = require_rays(sensor)
    topic = advertise_scan(names, parameters, "sensor_msgs/LaserScan", "scan")
    _listen(rays, SensorPublisher(topic, names.frame(parameters.text("frameName", "/world"))), as_points=False)
    parameters.ignore("gaussianNoise", "hokuyoMinIntensity", "updateRate")  # gazebo_ros reads none of them


def attach_ray_sensor(sensor: InstrumentSensor, parameters: TagParameters, names: PluginNames) -> None:
    """Publish as ROS 2's libgazebo_ros_ray_sensor.so: <output_type>, <frame_name>, <ros> with <namespace> and
    <remapping>~/out:=scan."""
    rays = require_rays(sensor)
    kind = parameters.text("output_type", "sensor_msgs/PointCloud2")
    ros, topic = parameters.section("ros"), "out"
    namespace = ros.text("namespace", names.namespace).strip("/")
    for remapping in ros.texts("remapping"):
        match = re.fullmatch(r"~/out\s*:=\s*(\S+)", remapping)
        topic = match[1] if match else topic
    ros.report_unread()
    as_points = {"sensor_msgs/LaserScan": False, "sensor_msgs/PointCloud2": True}.get(kind)
    if as_points is None:
        raise UsageError(f"output_type {kind!r} is not published; sensor_msgs/LaserScan and PointCloud2 are")
    frame = names.frame(parameters.text("frame_name", rays.link.name))
    _listen(rays, SensorPublisher(names.advertise(kind, join_topic(namespace, topic)), frame), as_points=as_points)


def advertise_scan(names: PluginNames, parameters: TagParameters, kind: str, default: str) -> TopicPublisher:
    """Advertise <topicName>; without it, the default and, as in the originals, /world."""
    return names.advertise(kind, *((parameters.text("topicName"),) if "topicName" in parameters else (default, _TOPIC)))


def require_rays(sensor: InstrumentSensor) -> RangeSensor:
    """Return the sensor if it casts rays.

    Raises:
        UsageError: it is of another type.
    """
    if not isinstance(sensor, RangeSensor):
        raise UsageError(f"sensor {sensor.name!r} is of type {sensor.sensor.type}; a ray sensor is needed")
    return sensor


def _listen(sensor: RangeSensor, publisher: SensorPublisher, *, as_points: bool) -> None:
    period_s = float(sensor.period_ns) / 1e9

    def publish(reading: RangeReading) -> None:
        publisher.publish(reading, lambda: points_message(reading) if as_points else scan_message(reading, period_s))

    sensor.listen(publish, enabled=publisher.has_subscribers)
