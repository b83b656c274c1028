"""sensor_msgs/CameraInfo of a camera."""

import math

import numpy as np

from trundle.robots.model import Lens, PixelIntrinsics
from trundle.sim.sensors import CameraSensor, radius_of
from trundle.spatial import Pose

_ALIGNED = 1e-6
"""Tolerance of parallel cameras: sine of half the angle between them, and distance [m] of their image planes."""
_TERMS = 4
"""Number of coefficients of ROS' model `equidistant`: θ (1 + k1 θ² + k2 θ⁴ + k3 θ⁶ + k4 θ⁸)."""


def camera_info_message(camera: CameraSensor) -> dict[str, object]:
    """Return image size, D, K, R and P.

    A pinhole has gazebo_ros's principal point (w + 1)/2, (h + 1)/2 unless the file has <intrinsics>. P's fourth column
    holds the baseline of a multicamera's parallel cameras to the first. A wide-angle lens gets the model `equidistant`,
    with fitted coefficients.
    """
    optics = camera.optics
    pinhole = optics.intrinsics or _pinhole(camera)
    distortion = optics.distortion
    model, coefficients = "plumb_bob", [distortion.k1, distortion.k2, distortion.p1, distortion.p2, distortion.k3]
    if optics.lens is not None:
        model = "equidistant"
        pinhole, coefficients = _wide(optics.lens, optics.horizontal_fov_rad, pinhole, optics.width_px)
    right, down = _baseline(camera)
    projection = optics.projection
    if projection is None:
        p = [pinhole.fx, pinhole.fy, pinhole.cx, pinhole.cy, 0.0 - pinhole.fx * right, 0.0 - pinhole.fy * down]
    else:
        p = [projection.fx, projection.fy, projection.cx, projection.cy, projection.tx, projection.ty]
    return {
        "height": optics.height_px,
        "width": optics.width_px,
        "distortion_model": model,
        "D": coefficients,
        "K": [pinhole.fx, pinhole.skew, pinhole.cx, 0.0, pinhole.fy, pinhole.cy, 0.0, 0.0, 1.0],
        "R": [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
        "P": [p[0], 0.0, p[2], p[4], 0.0, p[1], p[3], p[5], 0.0, 0.0, 1.0, 0.0],
    }


def _pinhole(camera: CameraSensor) -> PixelIntrinsics:
    intrinsics = camera.intrinsics
    f = intrinsics.focal_px
    return PixelIntrinsics(fx=f, fy=f, cx=(intrinsics.width_px + 1) / 2, cy=(intrinsics.height_px + 1) / 2)


def _wide(lens: Lens, fov_rad: float, pinhole: PixelIntrinsics, width_px: int) -> tuple[PixelIntrinsics, list[float]]:
    """Fit focal length and coefficients by least squares over the angles within the image's width."""
    angles = np.linspace(0.01, max(min(lens.cutoff_rad, fov_rad / 2), 0.02), 200)
    radii = radius_of(lens, fov_rad, angles) * width_px / 2
    is_finite = np.isfinite(radii)
    powers = np.stack([angles ** (2 * i + 1) for i in range(_TERMS + 1)], axis=-1)
    fitted, *_ = np.linalg.lstsq(powers[is_finite], radii[is_finite], rcond=None)
    focal = float(fitted[0])
    if not focal:
        return pinhole, [0.0] * _TERMS
    coefficients = [float(value) / focal for value in fitted[1:]]
    return PixelIntrinsics(fx=focal, fy=focal, cx=pinhole.cx, cy=pinhole.cy), coefficients


def _baseline(camera: CameraSensor) -> tuple[float, float]:
    """Offset of the camera to the right of the multicamera's first one, and below it [m]; zero if not parallel."""
    first: Pose = camera.sensor.cameras[0].sensor_from_camera
    first_from_camera = first.inverse() @ camera.optics.sensor_from_camera
    forward, left, up = first_from_camera.position
    rotation = math.hypot(*first_from_camera.quaternion[1:])
    if rotation > _ALIGNED or abs(forward) > _ALIGNED:
        return 0.0, 0.0
    return 0.0 - left, 0.0 - up
