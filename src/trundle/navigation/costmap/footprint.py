"""The robot's outline: read from parameters and messages, padded, measured."""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from trundle.base.yaml_loader import load_yaml
from trundle.robots.parameters import ParamError, RosParameters

_CIRCLE_CORNERS = 16
"""Number of corners that stand for a circle, as in costmap_2d."""
_MAX_CORNERS = 1000


def read_footprint(settings: RosParameters, robot_radius_m: float, padding_m: float) -> NDArray[np.float64]:
    """Read `footprint`, a list of points or its text, else a circle of `robot_radius`; padded.

    Raises:
        ParamError: the footprint is not a list of at least three points.
    """
    value: Any = settings.text("footprint", "") if not _is_list(settings) else settings.items("footprint")
    label = f"parameter {settings.namespace}/footprint"
    if isinstance(value, str):
        try:
            value = load_yaml(value) if value.strip() else []
        except Exception as error:  # PyYAML raises errors of many types for invalid text
            raise ParamError(f"{label}: {value!r} is not a list of points: {error}") from None
    points = corners(value or [], label)
    return padded(circle(robot_radius_m) if not len(points) else points, padding_m)


def _is_list(settings: RosParameters) -> bool:
    try:
        settings.items("footprint")
    except ParamError:
        return False
    return True


def corners(value: object, label: str) -> NDArray[np.float64]:
    """Return points (n, 2) [m] from nested lists; empty from an empty list.

    Raises:
        ParamError: the value is not a list of at least three points.
    """
    points: NDArray[np.float64]
    try:
        points = np.array(value, dtype=float)
    except (TypeError, ValueError):
        points = np.full((1, 1), np.nan)
    if points.size == 0:
        return np.empty((0, 2))
    if points.ndim != 2 or points.shape[1] != 2 or not 3 <= len(points) <= _MAX_CORNERS:
        raise ParamError(f"{label}: {str(value)[:200]} is not a list of at least three points [x, y]")
    if not np.isfinite(points).all():
        raise ParamError(f"{label}: {str(value)[:200]} has a number that is not finite")
    return points


def circle(radius_m: float) -> NDArray[np.float64]:
    """Return the 16 corners (16, 2) of a circle [m]."""
    angles = np.arange(_CIRCLE_CORNERS) * (2.0 * math.pi / _CIRCLE_CORNERS)
    return radius_m * np.stack([np.cos(angles), np.sin(angles)], axis=1)


def padded(points: NDArray[np.float64], padding_m: float) -> NDArray[np.float64]:
    """Move each corner outwards along both axes, as costmap_2d does."""
    return points + np.sign(points) * padding_m


def radii(points: NDArray[np.float64]) -> tuple[float, float]:
    """Return the radii of the inscribed and the circumscribed circle around the origin [m]."""
    following = np.roll(points, -1, axis=0)
    edges = following - points
    lengths = np.maximum((edges**2).sum(axis=1), 1e-12)
    share = np.clip(-(points * edges).sum(axis=1) / lengths, 0.0, 1.0)
    nearest = points + share[:, None] * edges
    return float(np.hypot(*nearest.T).min()), float(np.hypot(*points.T).max())


def placed(points: NDArray[np.float64], x: float, y: float, yaw: float) -> NDArray[np.float64]:
    """Return points (n, 2) of the robot's frame at its pose [m]."""
    cosine, sine = math.cos(yaw), math.sin(yaw)
    return points @ np.array([[cosine, sine], [-sine, cosine]]) + np.array([x, y])
