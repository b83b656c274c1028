"""Snapshots become readings."""

from .camera import CameraReading, CameraSensor
from .contact import ContactReading, ContactSensor
from .force_torque import ForceTorqueReading, ForceTorqueSensor
from .gps import GpsReading, GpsSensor
from .imu import ImuReading, ImuSensor
from .mount import SIMULATED, mount_cameras
from .mount_measuring import MeasuringSensor, mount_sensors
from .noise import NoiseSource
from .range import RangeReading, RangeSensor, angles_of, directions_of

__all__ = [
    "SIMULATED",
    "CameraReading",
    "CameraSensor",
    "ContactReading",
    "ContactSensor",
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
    "angles_of",
    "directions_of",
    "mount_cameras",
    "mount_sensors",
]
