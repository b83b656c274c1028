"""Table of sensor topics: SDF type → outputs, each with its message type, queue and message function."""

from collections.abc import Callable
from functools import partial
from typing import Any, NamedTuple, TypeAlias

from trundle.sim.sensors import CameraSensor, GpsSensor, InstrumentSensor, RangeSensor, SonarSensor

from .camera_info import camera_info_message
from .detection_messages import boxes_2d, boxes_3d
from .image_messages import depth_image, image_encoder, labels_image, point_cloud_encoder, thermal_image
from .instrument_messages import (
    altitude_message,
    field_message,
    models_message,
    nodes_message,
    pressure_message,
    range_message,
    tags_message,
    vertical_velocity_message,
)
from .sensor_messages import contacts_message, fix_message, imu_message, points_message, scan_message, wrench_message

Encode: TypeAlias = Callable[[Any], dict[str, object]]
"""Converts a reading to the fields of a message without its header."""
_MAX_S = 1e30
"""Largest LaserScan.scan_time [s]."""


class Condition(NamedTuple):
    """Condition of sensors of a type to have an output."""

    text: str
    """Text for the documentation; empty for the usual case."""
    holds: Callable[[Any], bool]


class SensorOutput(NamedTuple):
    """One topic of a sensor."""

    name: str
    """Last part of the topic's name."""
    type: str
    """Message type."""
    queue_size: int
    encoder: Callable[[Any], Encode]
    """Returns the message function of a sensor."""
    condition: Condition | None = None


def _always(encode: Encode) -> Callable[[Any], Encode]:
    """Return the same message function for all sensors."""
    return lambda _: encode


def _color_image(camera: CameraSensor) -> Encode:
    return image_encoder(camera.optics.format)


def _info(camera: CameraSensor) -> Encode:
    calibration = camera_info_message(camera)
    return lambda _: calibration


def _has_2d_boxes(camera: CameraSensor) -> bool:
    return camera.optics.box_type != "3d"


def _has_3d_boxes(camera: CameraSensor) -> bool:
    return camera.optics.box_type == "3d"


def _scan(sensor: RangeSensor) -> Encode:
    return partial(scan_message, period_s=min(1.0 / sensor.rate_hz, _MAX_S))


def _has_one_row(sensor: RangeSensor) -> bool:
    return sensor.scan.vertical.values == 1


def _has_rows(sensor: RangeSensor) -> bool:
    return sensor.scan.vertical.values != 1


def _fix(sensor: GpsSensor) -> Encode:
    return partial(fix_message, sensor=sensor)


def _range(sensor: SonarSensor) -> Encode:
    return partial(range_message, sensor=sensor)


def _camera(
    name: str, type_: str, encoder: Callable[[Any], Encode], condition: Condition | None = None
) -> SensorOutput:
    return SensorOutput(name, type_, 2, encoder, condition)


_IMAGE, _INFO, _DIAGNOSTICS = "sensor_msgs/Image", "sensor_msgs/CameraInfo", "diagnostic_msgs/DiagnosticArray"
_ONE_ROW, _ROWS = Condition("", _has_one_row), Condition("several rows of rays", _has_rows)
_2D, _3D = Condition("", _has_2d_boxes), Condition("boxes of type `3d`", _has_3d_boxes)

_COLOR = _camera("image_raw", _IMAGE, _color_image)
_CALIBRATION = _camera("camera_info", _INFO, _info)
_SCANS = (
    SensorOutput("scan", "sensor_msgs/LaserScan", 5, _scan, _ONE_ROW),
    SensorOutput("points", "sensor_msgs/PointCloud2", 2, _always(points_message), _ROWS),
)
_FIXES = (SensorOutput("fix", "sensor_msgs/NavSatFix", 5, _fix),)
_COLOR_CAMERA = (_COLOR, _CALIBRATION)
_DEPTH_CAMERA = (
    _COLOR,
    _CALIBRATION,
    _camera("depth/image_raw", _IMAGE, _always(depth_image)),
    _camera("depth/camera_info", _INFO, _info),
    _camera("points", "sensor_msgs/PointCloud2", point_cloud_encoder),
)
_SEGMENTATION_CAMERA = (
    _camera("labels_map", _IMAGE, _always(labels_image)),
    _CALIBRATION,
    _camera("colored_map", _IMAGE, _always(image_encoder("R8G8B8"))),
)
_BOX_CAMERA = (
    _camera("boxes", "vision_msgs/Detection2DArray", _always(boxes_2d), _2D),
    _camera("boxes", "vision_msgs/Detection3DArray", _always(boxes_3d), _3D),
    _CALIBRATION,
    _COLOR,
)
_THERMAL_CAMERA = (_camera("image_raw", _IMAGE, _always(thermal_image)), _CALIBRATION)

SENSOR_TOPICS: dict[str, tuple[SensorOutput, ...]] = {
    **dict.fromkeys(("camera", "multicamera", "wideanglecamera", "wide_angle_camera"), _COLOR_CAMERA),
    **dict.fromkeys(("depth", "depth_camera", "rgbd", "rgbd_camera"), _DEPTH_CAMERA),
    **dict.fromkeys(("segmentation", "segmentation_camera"), _SEGMENTATION_CAMERA),
    **dict.fromkeys(("boundingbox", "boundingbox_camera"), _BOX_CAMERA),
    **dict.fromkeys(("thermal", "thermal_camera"), _THERMAL_CAMERA),
    "logical_camera": (SensorOutput("models", "tf2_msgs/TFMessage", 5, _always(models_message)),),
    **dict.fromkeys(("ray", "gpu_ray", "lidar", "gpu_lidar"), _SCANS),
    "sonar": (SensorOutput("range", "sensor_msgs/Range", 5, _range),),
    "imu": (SensorOutput("imu", "sensor_msgs/Imu", 10, _always(imu_message)),),
    **dict.fromkeys(("gps", "navsat"), _FIXES),
    "magnetometer": (SensorOutput("magnetic_field", "sensor_msgs/MagneticField", 10, _always(field_message)),),
    "altimeter": (
        SensorOutput("altitude", "geometry_msgs/Vector3Stamped", 10, _always(altitude_message)),
        SensorOutput("vertical_velocity", "geometry_msgs/Vector3Stamped", 10, _always(vertical_velocity_message)),
    ),
    "air_pressure": (SensorOutput("air_pressure", "sensor_msgs/FluidPressure", 10, _always(pressure_message)),),
    "air_speed": (SensorOutput("air_speed", "sensor_msgs/FluidPressure", 10, _always(pressure_message)),),
    "contact": (SensorOutput("contacts", "gazebo_msgs/ContactsState", 5, _always(contacts_message)),),
    "force_torque": (SensorOutput("wrench", "geometry_msgs/WrenchStamped", 10, _always(wrench_message)),),
    "wireless_receiver": (SensorOutput("nodes", _DIAGNOSTICS, 5, _always(nodes_message)),),
    "rfid": (SensorOutput("tags", _DIAGNOSTICS, 5, _always(tags_message)),),
}
"""SDF type → its outputs, the main one first."""


def outputs_of(sensor: CameraSensor | InstrumentSensor) -> list[SensorOutput]:
    """Outputs that a sensor has, the main one first."""
    rows = SENSOR_TOPICS[sensor.sensor.type]
    return [row for row in rows if row.condition is None or row.condition.holds(sensor)]
