"""Topics of instruments: barometers, altimeters, magnetometers, sonars, logical cameras, radios."""

from trundle.ros import Node, StaticTransformBroadcaster
from trundle.sensors import (
    AirPressureSensor,
    AirSpeedSensor,
    AltimeterReading,
    AltimeterSensor,
    LogicalCameraReading,
    LogicalCameraSensor,
    MagnetometerReading,
    MagnetometerSensor,
    PressureReading,
    RfidReading,
    RfidSensor,
    SonarReading,
    SonarSensor,
    WirelessReading,
    WirelessSensor,
)

from .frame_names import WORLD_FRAME, FrameNames
from .sensor_frames import output_topic, send_sensor_frame

_ULTRASOUND = 0
"""sensor_msgs/Range.ULTRASOUND"""


class PressureTopic:
    """sensor_msgs/FluidPressure: static pressure on `…/air_pressure`, dynamic pressure on `…/air_speed`."""

    def __init__(
        self,
        node: Node,
        static_broadcaster: StaticTransformBroadcaster,
        sensor: AirPressureSensor | AirSpeedSensor,
        names: FrameNames,
    ) -> None:
        """Advertise, and send the sensor's frame."""
        self._frame = send_sensor_frame(sensor, sensor.sensor.link_from_sensor, static_broadcaster, names)
        self._topic = node.advertise(
            output_topic(sensor, sensor.sensor.type), "sensor_msgs/FluidPressure", queue_size=10
        )
        sensor.listen(self._publish, enabled=lambda: self._topic.has_subscribers)

    def _publish(self, reading: PressureReading) -> None:
        header = {"stamp": reading.time_ns, "frame_id": self._frame}
        self._topic.publish({"header": header, "fluid_pressure": reading.pressure, "variance": reading.variance})


class AltimeterTopics:
    """geometry_msgs/Vector3Stamped in world axes: z above the start [m] on `…/altitude`, its rate [m/s] on
    `…/vertical_velocity`."""

    def __init__(self, node: Node, sensor: AltimeterSensor) -> None:
        """Advertise."""
        self._height = node.advertise(output_topic(sensor, "altitude"), "geometry_msgs/Vector3Stamped", queue_size=10)
        speed = output_topic(sensor, "vertical_velocity", main="altitude")
        self._speed = node.advertise(speed, "geometry_msgs/Vector3Stamped", queue_size=10)
        sensor.listen(self._publish, enabled=lambda: self._height.has_subscribers or self._speed.has_subscribers)

    def _publish(self, reading: AltimeterReading) -> None:
        header = {"stamp": reading.time_ns, "frame_id": WORLD_FRAME}
        for topic, value in ((self._height, reading.height), (self._speed, reading.velocity)):
            if topic.has_subscribers:
                topic.publish({"header": header, "vector": {"z": value}})


class MagnetometerTopic:
    """sensor_msgs/MagneticField on `…/magnetic_field`."""

    def __init__(
        self, node: Node, static_broadcaster: StaticTransformBroadcaster, sensor: MagnetometerSensor, names: FrameNames
    ) -> None:
        """Advertise, and send the sensor's frame."""
        self._frame = send_sensor_frame(sensor, sensor.sensor.link_from_sensor, static_broadcaster, names)
        self._topic = node.advertise(output_topic(sensor, "magnetic_field"), "sensor_msgs/MagneticField", queue_size=10)
        sensor.listen(self._publish, enabled=lambda: self._topic.has_subscribers)

    def _publish(self, reading: MagnetometerReading) -> None:
        header = {"stamp": reading.time_ns, "frame_id": self._frame}
        field = dict(zip("xyz", reading.field, strict=True))
        self._topic.publish({"header": header, "magnetic_field": field})


class SonarTopic:
    """sensor_msgs/Range on `…/range`, in a frame whose x axis is the sonar's."""

    def __init__(
        self, node: Node, static_broadcaster: StaticTransformBroadcaster, sensor: SonarSensor, names: FrameNames
    ) -> None:
        """Advertise, and send the beam's frame."""
        self._frame = send_sensor_frame(sensor, sensor.link_from_beam, static_broadcaster, names)
        self._topic = node.advertise(output_topic(sensor, "range"), "sensor_msgs/Range", queue_size=5)
        self._sensor = sensor
        sensor.listen(self._publish, enabled=lambda: self._topic.has_subscribers)

    def _publish(self, reading: SonarReading) -> None:
        self._topic.publish(
            {
                "header": {"stamp": reading.time_ns, "frame_id": self._frame},
                "radiation_type": _ULTRASOUND,
                "field_of_view": self._sensor.fov_rad,
                "min_range": self._sensor.settings.min_m,
                "max_range": self._sensor.settings.max_m,
                "range": reading.range_m,
            }
        )


class LogicalCameraTopic:
    """tf2_msgs/TFMessage on `…/models`: the pose of each model in view, in the logical camera's frame."""

    def __init__(
        self, node: Node, static_broadcaster: StaticTransformBroadcaster, sensor: LogicalCameraSensor, names: FrameNames
    ) -> None:
        """Advertise, and send the sensor's frame."""
        self._frame = send_sensor_frame(sensor, sensor.sensor.link_from_sensor, static_broadcaster, names)
        self._topic = node.advertise(output_topic(sensor, "models"), "tf2_msgs/TFMessage", queue_size=5)
        sensor.listen(self._publish, enabled=lambda: self._topic.has_subscribers)

    def _publish(self, reading: LogicalCameraReading) -> None:
        transforms: list[dict[str, object]] = []
        for seen in reading.models:
            qw, qx, qy, qz = seen.camera_from_model.quaternion
            placed = {
                "translation": dict(zip("xyz", seen.camera_from_model.position, strict=True)),
                "rotation": {"x": qx, "y": qy, "z": qz, "w": qw},
            }
            header = {"stamp": reading.time_ns, "frame_id": self._frame}
            transforms.append({"header": header, "child_frame_id": seen.name, "transform": placed})
        self._topic.publish({"transforms": transforms})


class WirelessTopics:
    """diagnostic_msgs/DiagnosticArray: the transmitters received on `…/nodes`, the tags in range on `…/tags`."""

    def __init__(
        self,
        node: Node,
        static_broadcaster: StaticTransformBroadcaster,
        sensor: WirelessSensor | RfidSensor,
        names: FrameNames,
    ) -> None:
        """Advertise, and send the sensor's frame."""
        self._frame = send_sensor_frame(sensor, sensor.sensor.link_from_sensor, static_broadcaster, names)
        type_ = "diagnostic_msgs/DiagnosticArray"
        match sensor:
            case WirelessSensor():
                topic = self._topic = node.advertise(output_topic(sensor, "nodes"), type_, queue_size=5)
                sensor.listen(self._publish_nodes, enabled=lambda: topic.has_subscribers)
            case RfidSensor():
                topic = self._topic = node.advertise(output_topic(sensor, "tags"), type_, queue_size=5)
                sensor.listen(self._publish_tags, enabled=lambda: topic.has_subscribers)

    def _publish_nodes(self, reading: WirelessReading) -> None:
        status = [
            {
                "name": heard.name,
                "values": [
                    {"key": "frequency_mhz", "value": f"{heard.frequency_mhz:g}"},
                    {"key": "signal_level_dbm", "value": f"{heard.level_dbm:.3f}"},
                ],
            }
            for heard in reading.signals
        ]
        self._topic.publish({"header": {"stamp": reading.time_ns, "frame_id": self._frame}, "status": status})

    def _publish_tags(self, reading: RfidReading) -> None:
        status = [{"name": tag} for tag in reading.tags]
        self._topic.publish({"header": {"stamp": reading.time_ns, "frame_id": self._frame}, "status": status})
