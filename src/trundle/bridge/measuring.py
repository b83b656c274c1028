"""Readings on ROS topics of their own: `<model>/<link>/<sensor>/imu`, `…/scan` or `…/points`, `…/fix`,
`…/contacts`, `<model>/<joint>/<sensor>/wrench`."""

from collections.abc import Iterable

import numpy as np

from trundle.model import World
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
    LogicalCameraSensor,
    MagnetometerSensor,
    MeasuringSensor,
    RangeReading,
    RangeSensor,
    RfidSensor,
    SonarSensor,
    WirelessSensor,
    directions_of,
)
from trundle.spatial import Vector3, Wrench

from .instruments import (
    AltimeterTopics,
    MagnetometerTopic,
    ModelsTopic,
    PressureTopic,
    RadioTopic,
    SonarTopic,
)
from .naming import WORLD_FRAME, has_plain_frames, link_frame_name
from .placing import place_sensor, topic_of

_FLOAT32 = 7
"""sensor_msgs/PointField's number for it."""


def sensor_topics(
    node: Node, still: StaticTransformBroadcaster, sensors: Iterable[MeasuringSensor], world: World
) -> None:
    """Put every sensor's readings on topics of its own."""
    for sensor in sensors:
        match sensor:
            case ImuSensor():
                ImuTopic(node, still, sensor, world)
            case RangeSensor():
                ScanTopic(node, still, sensor, world)
            case GpsSensor():
                FixTopic(node, still, sensor, world)
            case ForceTorqueSensor():
                WrenchTopic(node, still, sensor, world)
            case ContactSensor():
                ContactsTopic(node, sensor)
            case AirPressureSensor() | AirSpeedSensor():
                PressureTopic(node, still, sensor, world)
            case AltimeterSensor():
                AltimeterTopics(node, sensor)
            case LogicalCameraSensor():
                ModelsTopic(node, still, sensor, world)
            case MagnetometerSensor():
                MagnetometerTopic(node, still, sensor, world)
            case SonarSensor():
                SonarTopic(node, still, sensor, world)
            case WirelessSensor() | RfidSensor():
                RadioTopic(node, still, sensor, world)


class ImuTopic:
    """sensor_msgs/Imu on `…/imu`."""

    def __init__(self, node: Node, still: StaticTransformBroadcaster, sensor: ImuSensor, world: World) -> None:
        """Advertise, and place the sensor's frame."""
        self._frame = place_sensor(sensor, sensor.sensor.link_from_sensor, still, world)
        self._imu = node.advertise(topic_of(sensor, "imu"), "sensor_msgs/Imu", queue_size=10)
        sensor.listen(self._publish, wanted=lambda: self._imu.has_subscribers)

    def _publish(self, reading: ImuReading) -> None:
        qw, qx, qy, qz = reading.orientation
        self._imu.publish(
            {
                "header": {"stamp": reading.time_ns, "frame_id": self._frame},
                "orientation": {"x": qx, "y": qy, "z": qz, "w": qw},
                "angular_velocity": dict(zip("xyz", reading.angular_velocity, strict=True)),
                "linear_acceleration": dict(zip("xyz", reading.linear_acceleration, strict=True)),
            }
        )


class ScanTopic:
    """sensor_msgs/LaserScan on `…/scan` for one row of rays, sensor_msgs/PointCloud2 on `…/points` for several."""

    def __init__(self, node: Node, still: StaticTransformBroadcaster, sensor: RangeSensor, world: World) -> None:
        """Advertise, and place the sensor's frame."""
        self._frame = place_sensor(sensor, sensor.sensor.link_from_sensor, still, world)
        self._period_s = float(sensor.period_ns) / 1e9
        self._directions = directions_of(sensor.scan)
        if sensor.scan.vertical.samples == 1:
            self._topic = node.advertise(topic_of(sensor, "scan"), "sensor_msgs/LaserScan", queue_size=5)
            sensor.listen(self._publish_scan, wanted=lambda: self._topic.has_subscribers)
        else:
            self._topic = node.advertise(topic_of(sensor, "points"), "sensor_msgs/PointCloud2", queue_size=2)
            sensor.listen(self._publish_points, wanted=lambda: self._topic.has_subscribers)

    def _publish_scan(self, reading: RangeReading) -> None:
        fan = reading.scan.horizontal
        self._topic.publish(
            {
                "header": {"stamp": reading.time_ns, "frame_id": self._frame},
                "angle_min": fan.min_angle,
                "angle_max": fan.max_angle,
                "angle_increment": (fan.max_angle - fan.min_angle) / max(fan.samples - 1, 1),
                "scan_time": self._period_s,
                "range_min": reading.scan.min_m,
                "range_max": reading.scan.max_m,
                "ranges": reading.ranges[0].astype(np.float32),
                "intensities": reading.intensities[0].astype(np.float32),
            }
        )

    def _publish_points(self, reading: RangeReading) -> None:
        """Points and their intensities in the sensor's frame, without those that found nothing."""
        ranges = reading.ranges.reshape(-1)
        seen = np.isfinite(ranges)
        places = self._directions[seen] * ranges[seen, None]
        points = np.column_stack([places, reading.intensities.reshape(-1)[seen]]).astype("<f4")
        self._topic.publish(
            {
                "header": {"stamp": reading.time_ns, "frame_id": self._frame},
                "height": 1,
                "width": len(points),
                "fields": [
                    {"name": name, "offset": 4 * i, "datatype": _FLOAT32, "count": 1}
                    for i, name in enumerate(("x", "y", "z", "intensity"))
                ],
                "point_step": 16,
                "row_step": 16 * len(points),
                "data": np.frombuffer(points.tobytes(), dtype=np.uint8),
                "is_dense": True,
            }
        )


class FixTopic:
    """sensor_msgs/NavSatFix on `…/fix`."""

    def __init__(self, node: Node, still: StaticTransformBroadcaster, sensor: GpsSensor, world: World) -> None:
        """Advertise, and place the sensor's frame."""
        self._frame = place_sensor(sensor, sensor.sensor.link_from_sensor, still, world)
        across, up = sensor.variances
        self._covariance = [across, 0.0, 0.0, 0.0, across, 0.0, 0.0, 0.0, up]
        self._fix = node.advertise(topic_of(sensor, "fix"), "sensor_msgs/NavSatFix", queue_size=5)
        sensor.listen(self._publish, wanted=lambda: self._fix.has_subscribers)

    def _publish(self, reading: GpsReading) -> None:
        self._fix.publish(
            {
                "header": {"stamp": reading.time_ns, "frame_id": self._frame},
                "status": {"status": 0, "service": 1},
                "latitude": reading.latitude_deg,
                "longitude": reading.longitude_deg,
                "altitude": reading.altitude,
                "position_covariance": self._covariance,
                "position_covariance_type": 2,
            }
        )


class WrenchTopic:
    """geometry_msgs/WrenchStamped on `<model>/<joint>/<sensor>/wrench`, in the frame that the sensor names."""

    def __init__(self, node: Node, still: StaticTransformBroadcaster, sensor: ForceTorqueSensor, world: World) -> None:
        """Advertise, and place the sensor's frame."""
        own = place_sensor(sensor, sensor.link_from_sensor, still, world)
        plain = has_plain_frames(world)
        parent = sensor.joint.parent
        self._frame = {
            "child": link_frame_name(sensor.model, sensor.link.name, plain=plain),
            "parent": WORLD_FRAME if parent == "world" else link_frame_name(sensor.model, parent, plain=plain),
        }.get(sensor.settings.frame, own)
        self._topic = node.advertise(topic_of(sensor, "wrench"), "geometry_msgs/WrenchStamped", queue_size=10)
        sensor.listen(self._publish, wanted=lambda: self._topic.has_subscribers)

    def _publish(self, reading: ForceTorqueReading) -> None:
        header = {"stamp": reading.time_ns, "frame_id": self._frame}
        self._topic.publish({"header": header, "wrench": _wrench(reading.wrench)})


class ContactsTopic:
    """gazebo_msgs/ContactsState on `…/contacts`, in the world frame; one state for each pair of collisions."""

    def __init__(self, node: Node, sensor: ContactSensor) -> None:
        """Advertise."""
        self._contacts = node.advertise(topic_of(sensor, "contacts"), "gazebo_msgs/ContactsState", queue_size=5)
        sensor.listen(self._publish, wanted=lambda: self._contacts.has_subscribers)

    def _publish(self, reading: ContactReading) -> None:
        states: list[dict[str, object]] = []
        for pair in dict.fromkeys((touch.own, touch.other) for touch in reading.touches):
            touches = [touch for touch in reading.touches if (touch.own, touch.other) == pair]
            total = sum((touch.wrench for touch in touches), start=Wrench())
            states.append(
                {
                    "info": "",
                    "collision1_name": pair[0],
                    "collision2_name": pair[1],
                    "wrenches": [_wrench(touch.wrench) for touch in touches],
                    "total_wrench": _wrench(total),
                    "contact_positions": [_vector(touch.position) for touch in touches],
                    "contact_normals": [_vector(touch.normal) for touch in touches],
                    "depths": [touch.depth for touch in touches],
                }
            )
        self._contacts.publish({"header": {"stamp": reading.time_ns, "frame_id": WORLD_FRAME}, "states": states})


def _wrench(wrench: Wrench) -> dict[str, object]:
    return {"force": _vector(wrench.force), "torque": _vector(wrench.torque)}


def _vector(vector: Vector3) -> dict[str, float]:
    return dict(zip("xyz", vector, strict=True))
