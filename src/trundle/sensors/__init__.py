"""Snapshots become readings."""

from typing import TYPE_CHECKING

from trundle.doors import opened_on_use

if TYPE_CHECKING:
    from .air import AirPressureSensor, AirSpeedSensor, PressureReading
    from .altimeter import AltimeterReading, AltimeterSensor
    from .bounding_box_camera import BoundingBoxCameraSensor
    from .camera import CameraReading, CameraSensor, SeenBox
    from .contact import ContactReading, ContactSensor, Touch
    from .depth_camera import DepthCameraSensor
    from .force_torque import ForceTorqueReading, ForceTorqueSensor
    from .formats import pixels_in
    from .gps import GpsReading, GpsSensor, geodetic
    from .imu import ImuReading, ImuSensor
    from .lens import radius_of
    from .logical_camera import LogicalCameraReading, LogicalCameraSensor
    from .magnetometer import MagnetometerReading, MagnetometerSensor
    from .measuring import mount_sensors
    from .mount import SIMULATED, mount_cameras
    from .mount_measuring import MeasuringSensor
    from .mounted import Spot
    from .noise import NoiseSource
    from .range import RangeReading, RangeSensor, angles_of, directions_of
    from .scenery import Scenery
    from .segmentation_camera import SegmentationCameraSensor
    from .sonar import SonarReading, SonarSensor
    from .surroundings import Surroundings
    from .thermal_camera import ThermalCameraSensor
    from .view import PinholeView, View
    from .wireless import RfidReading, RfidSensor, WirelessReading, WirelessSensor

_HOMES = {
    "AirPressureSensor": "air",
    "AirSpeedSensor": "air",
    "AltimeterReading": "altimeter",
    "AltimeterSensor": "altimeter",
    "BoundingBoxCameraSensor": "bounding_box_camera",
    "CameraReading": "camera",
    "CameraSensor": "camera",
    "ContactReading": "contact",
    "ContactSensor": "contact",
    "DepthCameraSensor": "depth_camera",
    "ForceTorqueReading": "force_torque",
    "ForceTorqueSensor": "force_torque",
    "GpsReading": "gps",
    "GpsSensor": "gps",
    "ImuReading": "imu",
    "ImuSensor": "imu",
    "LogicalCameraReading": "logical_camera",
    "LogicalCameraSensor": "logical_camera",
    "MagnetometerReading": "magnetometer",
    "MagnetometerSensor": "magnetometer",
    "MeasuringSensor": "mount_measuring",
    "NoiseSource": "noise",
    "PinholeView": "view",
    "PressureReading": "air",
    "RangeReading": "range",
    "RangeSensor": "range",
    "RfidReading": "wireless",
    "RfidSensor": "wireless",
    "SIMULATED": "mount",
    "Scenery": "scenery",
    "SeenBox": "camera",
    "SegmentationCameraSensor": "segmentation_camera",
    "SonarReading": "sonar",
    "SonarSensor": "sonar",
    "Spot": "mounted",
    "Surroundings": "surroundings",
    "ThermalCameraSensor": "thermal_camera",
    "Touch": "contact",
    "View": "view",
    "WirelessReading": "wireless",
    "WirelessSensor": "wireless",
    "angles_of": "range",
    "directions_of": "range",
    "geodetic": "gps",
    "mount_cameras": "mount",
    "mount_sensors": "measuring",
    "pixels_in": "formats",
    "radius_of": "lens",
}
__getattr__ = opened_on_use(__name__, _HOMES)

__all__ = [
    "SIMULATED",
    "AirPressureSensor",
    "AirSpeedSensor",
    "AltimeterReading",
    "AltimeterSensor",
    "BoundingBoxCameraSensor",
    "CameraReading",
    "CameraSensor",
    "ContactReading",
    "ContactSensor",
    "DepthCameraSensor",
    "ForceTorqueReading",
    "ForceTorqueSensor",
    "GpsReading",
    "GpsSensor",
    "ImuReading",
    "ImuSensor",
    "LogicalCameraReading",
    "LogicalCameraSensor",
    "MagnetometerReading",
    "MagnetometerSensor",
    "MeasuringSensor",
    "NoiseSource",
    "PinholeView",
    "PressureReading",
    "RangeReading",
    "RangeSensor",
    "RfidReading",
    "RfidSensor",
    "Scenery",
    "SeenBox",
    "SegmentationCameraSensor",
    "SonarReading",
    "SonarSensor",
    "Spot",
    "Surroundings",
    "ThermalCameraSensor",
    "Touch",
    "View",
    "WirelessReading",
    "WirelessSensor",
    "angles_of",
    "directions_of",
    "geodetic",
    "mount_cameras",
    "mount_sensors",
    "pixels_in",
    "radius_of",
]
