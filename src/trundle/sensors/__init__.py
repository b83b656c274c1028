"""Snapshots become readings."""

from .camera import CameraReading, CameraSensor
from .imu import ImuReading, ImuSensor
from .mount import SIMULATED, mount_cameras
from .mount_measuring import mount_sensors
from .range import RangeReading, RangeSensor, angles_of, directions_of

__all__ = [
    "SIMULATED",
    "CameraReading",
    "CameraSensor",
    "ImuReading",
    "ImuSensor",
    "RangeReading",
    "RangeSensor",
    "angles_of",
    "directions_of",
    "mount_cameras",
    "mount_sensors",
]
