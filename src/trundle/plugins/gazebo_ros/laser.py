"""libgazebo_ros_laser.so, libgazebo_ros_gpu_laser.so and their variants: scans and point clouds of a ray sensor."""

import re

from trundle.bridge import points_message, scan_message
from trundle.diagnostics import UsageError
from trundle.parameters import TagParameters
from trundle.ros import Node
from trundle.sensors import InstrumentSensor, RangeReading, RangeSensor

from .namespaces import join_topic, read_namespace
from .sensor_publisher import SensorPublisher, read_frame_name, read_topic_name


def attach(sensor: InstrumentSensor, node: Node, parameters: TagParameters) -> None:
    """Publish sensor_msgs/LaserScan on <topicName> (scan) in <frameName> (world)."""
    rays = _rays(sensor)
    topic = read_topic_name(parameters, read_namespace(parameters, sensor.model.name), "topicName", "scan")
    _listen(
        rays,
        SensorPublisher(node, topic, "sensor_msgs/LaserScan", read_frame_name(parameters, "world")),
        as_points=False,
    )
    parameters.ignore("gaussianNoise", "hokuyoMinIntensity", "updateRate")  # gazebo_ros reads none of them


def attach_points(sensor: InstrumentSensor, node: Node, parameters: TagParameters) -> None:
    """libgazebo_ros_block_laser.so and velodyne's: sensor_msgs/PointCloud2 on <topicName> (points)."""
    rays = _rays(sensor)
    topic = read_topic_name(parameters, read_namespace(parameters, sensor.model.name), "topicName", "points")
    _listen(
        rays,
        SensorPublisher(node, topic, "sensor_msgs/PointCloud2", read_frame_name(parameters, "world")),
        as_points=True,
    )
    parameters.warn_unsupported("gaussianNoise", "min_range", "max_range", "min_intensity")
    parameters.ignore("hokuyoMinIntensity", "updateRate", "organize_cloud")


def attach_ray_sensor(sensor: InstrumentSensor, node: Node, parameters: TagParameters) -> None:
    """libgazebo_ros_ray_sensor.so, as files for ROS 2 have it: <output_type>, <frame_name>, <ros> with <namespace> and
    <remapping>~/out:=scan."""
    rays = _rays(sensor)
    kind = parameters.text("output_type", "sensor_msgs/PointCloud2")
    namespace, topic = read_namespace(parameters, sensor.model.name), "out"
    ros = parameters.section("ros")
    namespace = ros.text("namespace", namespace).strip("/")
    for remapping in ros.texts("remapping"):
        found = re.fullmatch(r"~/out\s*:=\s*(\S+)", remapping)
        topic = found[1] if found else topic
    ros.report_unread()
    outlet = {"sensor_msgs/LaserScan": False, "sensor_msgs/PointCloud2": True}.get(kind)
    if outlet is None:
        raise UsageError(f"output_type {kind!r} is not published; sensor_msgs/LaserScan and PointCloud2 are")
    frame = parameters.text("frame_name", rays.link.name)
    _listen(rays, SensorPublisher(node, join_topic(namespace, topic), kind, frame), as_points=outlet)


def _rays(sensor: InstrumentSensor) -> RangeSensor:
    if not isinstance(sensor, RangeSensor):
        raise UsageError(f"sensor {sensor.name!r} is of type {sensor.sensor.type}; a ray sensor is needed")
    return sensor


def _listen(sensor: RangeSensor, outlet: SensorPublisher, *, as_points: bool) -> None:
    period_s = float(sensor.period_ns) / 1e9

    def publish(reading: RangeReading) -> None:
        outlet.publish(reading, lambda: points_message(reading) if as_points else scan_message(reading, period_s))

    sensor.listen(publish, enabled=outlet.has_subscribers)
