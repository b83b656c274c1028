"""Wide lenses, as SDF states them."""

import math

import numpy as np
from numpy.typing import NDArray

from trundle.model import Lens
from trundle.spatial import Pose

_Array = NDArray[np.float64]
_RIGHT_ANGLE = math.pi / 2
CUBE = (
    Pose(),
    *(Pose.from_rpy(0.0, 0.0, 0.0, yaw=turn * _RIGHT_ANGLE) for turn in (1, 2, 3)),
    *(Pose.from_rpy(0.0, 0.0, 0.0, pitch=turn * _RIGHT_ANGLE) for turn in (-1, 1)),
)
"""camera_from_face of pinholes a quarter turn wide that look ahead, left, back, right, up and down."""


def focal_of(lens: Lens, fov_rad: float) -> float:
    """The f of r = c1 f fun(θ / c2 + c3); where it is to fit the field of view and no f does, the lens' own."""
    if not lens.scale_to_hfov or not fits(lens, fov_rad):
        return lens.f
    return 1.0 / _edge(lens, fov_rad)


def fits(lens: Lens, fov_rad: float) -> bool:
    """Whether some f makes the picture's width hold this field of view."""
    return math.isfinite(_edge(lens, fov_rad)) and _edge(lens, fov_rad) > 0.0


def _edge(lens: Lens, fov_rad: float) -> float:
    return lens.c1 * _fun(lens.fun, fov_rad / 2 / lens.c2 + lens.c3)


def radius_of(lens: Lens, fov_rad: float, angles: _Array) -> _Array:
    """How far from the middle rays at these angles from the axis are seen; half the picture's width is 1."""
    scale = lens.c1 * focal_of(lens, fov_rad)
    return np.array([scale * _fun(lens.fun, angle / lens.c2 + lens.c3) for angle in angles.tolist()])


def directions_through(lens: Lens, fov_rad: float, x: _Array, y: _Array) -> tuple[_Array, NDArray[np.bool_]]:
    """Where pixels look: (…, 3) unit vectors in the camera's frame, and whether they see anything.

    Args:
        lens: that they look through.
        fov_rad: what the picture's width holds.
        x: right of the middle; half the picture's width is 1.
        y: below the middle, likewise.
    """
    radius = np.hypot(x, y)
    known = radius / (lens.c1 * focal_of(lens, fov_rad))
    with np.errstate(invalid="ignore"):
        match lens.fun:
            case "tan":
                inner = np.arctan(known)
            case "sin":
                inner = np.arcsin(known)
            case _:
                inner = known
    angle = (inner - lens.c3) * lens.c2
    seen = np.isfinite(angle) & (angle >= 0.0) & (angle <= min(lens.cutoff_rad, math.pi))
    angle = np.where(seen, angle, 0.0)
    across = np.sin(angle) / np.maximum(radius, 1e-12)
    return np.stack([np.cos(angle), -across * x, -across * y], axis=-1), seen


def _fun(name: str, angle: float) -> float:
    match name:
        case "tan":
            return math.tan(angle) if abs(angle) < _RIGHT_ANGLE else math.inf
        case "sin":
            return math.sin(angle)
        case _:
            return angle
