"""Snapshots become readings."""

from .camera import CameraReading, CameraSensor
from .mount import SIMULATED, mount_cameras

__all__ = ["SIMULATED", "CameraReading", "CameraSensor", "mount_cameras"]
