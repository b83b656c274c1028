"""Snapshots become readings."""

from .bounding_box_camera import BoundingBoxCameraSensor
from .camera import CameraReading, CameraSensor, SeenBox
from .contact import ContactReading, ContactSensor
from .depth_camera import DepthCameraSensor
from .force_torque import ForceTorqueReading, ForceTorqueSensor
from .formats import pixels_in
from .gps import GpsReading, GpsSensor
from .imu import ImuReading, ImuSensor
from .lens import radius_of
from .mount import SIMULATED, mount_cameras
from .mount_measuring import MeasuringSensor, mount_sensors
from .noise import NoiseSource
from .range import RangeReading, RangeSensor, angles_of, directions_of
from .scenery import Scenery
from .segmentation_camera import SegmentationCameraSensor
from .thermal_camera import ThermalCameraSensor

__all__ = [
    "SIMULATED",
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
    "MeasuringSensor",
    "NoiseSource",
    "RangeReading",
    "RangeSensor",
    "Scenery",
    "SeenBox",
    "SegmentationCameraSensor",
    "ThermalCameraSensor",
    "angles_of",
    "directions_of",
    "mount_cameras",
    "mount_sensors",
    "pixels_in",
    "radius_of",
]
