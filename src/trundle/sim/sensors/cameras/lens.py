"""Wide-angle lenses of SDF."""

import math

import numpy as np
from numpy.typing import NDArray

from trundle.robots.model import Lens
from trundle.spatial import Pose

_Array = NDArray[np.float64]
_RIGHT_ANGLE = math.pi / 2
CUBE = (
    Pose(),
    *(Pose.from_rpy(0.0, 0.0, 0.0, yaw=turn * _RIGHT_ANGLE) for turn in (1, 2, 3)),
    *(Pose.from_rpy(0.0, 0.0, 0.0, pitch=turn * _RIGHT_ANGLE) for turn in (-1, 1)),
)
"""camera_from_face of 90° pinholes that look ahead, left, back, right, up and down."""


def focal_of(lens: Lens, fov_rad: float) -> float:
    """Return f of r = c1 f fun(θ / c2 + c3): scaled to the field of view if possible, else the lens' f."""
    if not lens.scale_to_hfov or not fits(lens, fov_rad):
        return lens.f
    return 1.0 / _edge(lens, fov_rad)


def fits(lens: Lens, fov_rad: float) -> bool:
    """True if some f makes the image width span this field of view."""
    return math.isfinite(_edge(lens, fov_rad)) and _edge(lens, fov_rad) > 0.0


def _edge(lens: Lens, fov_rad: float) -> float:
    return lens.c1 * _fun(lens.fun, fov_rad / 2 / lens.c2 + lens.c3)


def radius_of(lens: Lens, fov_rad: float, angles: _Array) -> _Array:
    """Return the image radius of rays at angles from the axis; half the image width is 1."""
    scale = lens.c1 * focal_of(lens, fov_rad)
    return np.array([scale * _fun(lens.fun, angle / lens.c2 + lens.c3) for angle in angles.tolist()])


def directions_through(lens: Lens, fov_rad: float, x: _Array, y: _Array) -> tuple[_Array, NDArray[np.bool_]]:
    """Return the view ray of each pixel.

    Args:
        lens: lens parameters.
        fov_rad: horizontal field of view.
        x: right of the image centre; half the image width is 1.
        y: below the image centre, in the same unit.

    Returns:
        (…, 3) unit vectors in the camera frame, and a mask of the pixels that the lens images.
    """
    radius = np.hypot(x, y)
    ratio = radius / (lens.c1 * focal_of(lens, fov_rad))
    with np.errstate(invalid="ignore"):
        match lens.fun:
            case "tan":
                inner = np.arctan(ratio)
            case "sin":
                inner = np.arcsin(ratio)
            case _:
                inner = ratio
    angle = (inner - lens.c3) * lens.c2
    is_valid = np.isfinite(angle) & (angle >= 0.0) & (angle <= min(lens.cutoff_rad, math.pi))
    angle = np.where(is_valid, angle, 0.0)
    across = np.sin(angle) / np.maximum(radius, 1e-12)
    return np.stack([np.cos(angle), -across * x, -across * y], axis=-1), is_valid


def _fun(name: str, angle: float) -> float:
    match name:
        case "tan":
            return math.tan(angle) if abs(angle) < _RIGHT_ANGLE else math.inf
        case "sin":
            return math.sin(angle)
        case _:
            return angle
