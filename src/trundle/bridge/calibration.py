"""What camera_info says."""

from trundle.sensors import CameraSensor
from trundle.spatial import Pose


def calibration_of(camera: CameraSensor) -> dict[str, object]:
    """K, D, R and P of a pinhole without distortion, with gazebo_ros's principal point (w + 1)/2, (h + 1)/2.

    Of a multicamera's cameras, P's fourth column says where each is from the first one, if they look the same way.
    """
    seen = camera.intrinsics
    f, cx, cy = seen.focal_px, (seen.width_px + 1) / 2, (seen.height_px + 1) / 2
    right, down = _baseline(camera)
    return {
        "height": seen.height_px,
        "width": seen.width_px,
        "distortion_model": "plumb_bob",
        "D": [0.0] * 5,
        "K": [f, 0.0, cx, 0.0, f, cy, 0.0, 0.0, 1.0],
        "R": [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
        "P": [f, 0.0, cx, -f * right, 0.0, f, cy, -f * down, 0.0, 0.0, 1.0, 0.0],
    }


_ALIGNED = 1e-6
"""Sine of half the angle [rad] between cameras that count as looking the same way."""


def _baseline(camera: CameraSensor) -> tuple[float, float]:
    """How far the camera is to the right of the multicamera's first, and below it [m]."""
    first: Pose = camera.sensor.cameras[0].sensor_from_camera
    first_from_camera = first.inverse() @ camera.optics.sensor_from_camera
    ahead, left, up = first_from_camera.position
    turned = max(map(abs, first_from_camera.quaternion[1:]))
    if turned > _ALIGNED or abs(ahead) > _ALIGNED:
        return 0.0, 0.0
    return 0.0 - left, 0.0 - up
