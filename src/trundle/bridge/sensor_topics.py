"""Topics of sensor readings: `<model>/<link>/<sensor>/imu`, `…/scan` or `…/points`, `…/fix`, `…/contacts`,
`<model>/<joint>/<sensor>/wrench`."""

from collections.abc import Iterable

from trundle.ros import Node, StaticTransformBroadcaster
from trundle.sensors import (
    AirPressureSensor,
    AirSpeedSensor,
    AltimeterSensor,
    ContactReading,
    ContactSensor,
    ForceTorqueReading,
    ForceTorqueSensor,
    GpsReading,
    GpsSensor,
    ImuReading,
    ImuSensor,
    InstrumentSensor,
    LogicalCameraSensor,
    MagnetometerSensor,
    RangeReading,
    RangeSensor,
    RfidSensor,
    SonarSensor,
    WirelessSensor,
)

from .frame_names import WORLD_FRAME, FrameNames
from .instrument_topics import (
    AltimeterTopics,
    LogicalCameraTopic,
    MagnetometerTopic,
    PressureTopic,
    SonarTopic,
    WirelessTopics,
)
from .sensor_frames import output_topic, send_sensor_frame
from .sensor_messages import contacts_message, fix_message, imu_message, points_message, scan_message, wrench_message

_MAX_S = 1e30
"""Largest LaserScan.scan_time [s]."""


def make_sensor_topics(
    node: Node, static_broadcaster: StaticTransformBroadcaster, sensors: Iterable[InstrumentSensor], names: FrameNames
) -> None:
    """Advertise the topics of sensors."""
    for sensor in sensors:
        match sensor:
            case ImuSensor():
                ImuTopic(node, static_broadcaster, sensor, names)
            case RangeSensor():
                ScanTopic(node, static_broadcaster, sensor, names)
            case GpsSensor():
                FixTopic(node, static_broadcaster, sensor, names)
            case ForceTorqueSensor():
                WrenchTopic(node, static_broadcaster, sensor, names)
            case ContactSensor():
                ContactsTopic(node, sensor)
            case AirPressureSensor() | AirSpeedSensor():
                PressureTopic(node, static_broadcaster, sensor, names)
            case AltimeterSensor():
                AltimeterTopics(node, sensor)
            case LogicalCameraSensor():
                LogicalCameraTopic(node, static_broadcaster, sensor, names)
            case MagnetometerSensor():
                MagnetometerTopic(node, static_broadcaster, sensor, names)
            case SonarSensor():
                SonarTopic(node, static_broadcaster, sensor, names)
            case WirelessSensor() | RfidSensor():
                WirelessTopics(node, static_broadcaster, sensor, names)


class ImuTopic:
    """sensor_msgs/Imu on `…/imu`."""

    def __init__(
        self, node: Node, static_broadcaster: StaticTransformBroadcaster, sensor: ImuSensor, names: FrameNames
    ) -> None:
        """Advertise, and send the sensor's frame."""
        self._frame = send_sensor_frame(sensor, sensor.sensor.link_from_sensor, static_broadcaster, names)
        self._imu = node.advertise(output_topic(sensor, "imu"), "sensor_msgs/Imu", queue_size=10)
        sensor.listen(self._publish, enabled=lambda: self._imu.has_subscribers)

    def _publish(self, reading: ImuReading) -> None:
        self._imu.publish({**imu_message(reading), "header": {"stamp": reading.time_ns, "frame_id": self._frame}})


class ScanTopic:
    """sensor_msgs/LaserScan on `…/scan` of one row of rays, sensor_msgs/PointCloud2 on `…/points` of several."""

    def __init__(
        self, node: Node, static_broadcaster: StaticTransformBroadcaster, sensor: RangeSensor, names: FrameNames
    ) -> None:
        """Advertise, and send the sensor's frame."""
        self._frame = send_sensor_frame(sensor, sensor.sensor.link_from_sensor, static_broadcaster, names)
        self._period_s = min(1.0 / sensor.rate_hz, _MAX_S)
        if sensor.scan.vertical.values == 1:
            self._topic = node.advertise(output_topic(sensor, "scan"), "sensor_msgs/LaserScan", queue_size=5)
            sensor.listen(self._publish_scan, enabled=lambda: self._topic.has_subscribers)
        else:
            self._topic = node.advertise(output_topic(sensor, "points"), "sensor_msgs/PointCloud2", queue_size=2)
            sensor.listen(self._publish_points, enabled=lambda: self._topic.has_subscribers)

    def _publish_scan(self, reading: RangeReading) -> None:
        header = {"stamp": reading.time_ns, "frame_id": self._frame}
        self._topic.publish({**scan_message(reading, self._period_s), "header": header})

    def _publish_points(self, reading: RangeReading) -> None:
        self._topic.publish({**points_message(reading), "header": {"stamp": reading.time_ns, "frame_id": self._frame}})


class FixTopic:
    """sensor_msgs/NavSatFix on `…/fix`."""

    def __init__(
        self, node: Node, static_broadcaster: StaticTransformBroadcaster, sensor: GpsSensor, names: FrameNames
    ) -> None:
        """Advertise, and send the sensor's frame."""
        self._frame = send_sensor_frame(sensor, sensor.sensor.link_from_sensor, static_broadcaster, names)
        self._sensor = sensor
        self._fix = node.advertise(output_topic(sensor, "fix"), "sensor_msgs/NavSatFix", queue_size=5)
        sensor.listen(self._publish, enabled=lambda: self._fix.has_subscribers)

    def _publish(self, reading: GpsReading) -> None:
        header = {"stamp": reading.time_ns, "frame_id": self._frame}
        self._fix.publish({**fix_message(reading, self._sensor), "header": header})


class WrenchTopic:
    """geometry_msgs/WrenchStamped on `<model>/<joint>/<sensor>/wrench`, in the sensor's <frame>."""

    def __init__(
        self, node: Node, static_broadcaster: StaticTransformBroadcaster, sensor: ForceTorqueSensor, names: FrameNames
    ) -> None:
        """Advertise, and send the sensor's frame."""
        own = send_sensor_frame(sensor, sensor.link_from_sensor, static_broadcaster, names)
        parent = sensor.joint.parent
        self._frame = {
            "child": names.link(sensor.model, sensor.link.name),
            "parent": WORLD_FRAME if parent == "world" else names.link(sensor.model, parent),
        }.get(sensor.settings.frame, own)
        self._topic = node.advertise(output_topic(sensor, "wrench"), "geometry_msgs/WrenchStamped", queue_size=10)
        sensor.listen(self._publish, enabled=lambda: self._topic.has_subscribers)

    def _publish(self, reading: ForceTorqueReading) -> None:
        self._topic.publish({**wrench_message(reading), "header": {"stamp": reading.time_ns, "frame_id": self._frame}})


class ContactsTopic:
    """gazebo_msgs/ContactsState on `…/contacts`, in the world frame; see `contacts_message`."""

    def __init__(self, node: Node, sensor: ContactSensor) -> None:
        """Advertise."""
        self._contacts = node.advertise(output_topic(sensor, "contacts"), "gazebo_msgs/ContactsState", queue_size=5)
        sensor.listen(self._publish, enabled=lambda: self._contacts.has_subscribers)

    def _publish(self, reading: ContactReading) -> None:
        header = {"stamp": reading.time_ns, "frame_id": WORLD_FRAME}
        self._contacts.publish({**contacts_message(reading), "header": header})
