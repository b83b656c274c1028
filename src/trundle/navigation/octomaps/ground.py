"""Which points of a cloud are the ground."""

import math

import numpy as np
from numpy.typing import NDArray

from .octomap_settings import GroundFilter

_TRIES = 100
_LEAST_POINTS = 50
"""Points of a plane below which it is none."""


def is_ground(points: NDArray[np.float64], settings: GroundFilter) -> NDArray[np.bool_]:
    """Return which points (n, 3) in the robot's frame [m] are of the ground.

    It is the plane near z = 0 with the most points, by random samples (RANSAC) among those planes that are level;
    without one, whatever is near z = 0.
    """
    near = np.abs(points[:, 2]) < settings.plane_distance + settings.distance
    candidates = points[near]
    best = np.zeros(len(points), dtype=bool)
    if len(candidates) >= _LEAST_POINTS:
        random = np.random.default_rng(0)
        for corners in candidates[random.integers(len(candidates), size=(_TRIES, 3))]:
            normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
            length = float(np.linalg.norm(normal))
            if length < 1e-9 or abs(normal[2]) < math.cos(settings.angle) * length:
                continue
            offset = float(normal @ corners[0]) / length
            if abs(offset) >= settings.plane_distance:
                continue
            found = np.abs(points @ normal / length - offset) < settings.distance
            if found.sum() > best.sum():
                best = found
    if best.sum() >= _LEAST_POINTS:
        return best
    return np.abs(points[:, 2]) < settings.plane_distance
