"""A drive through the small house with a scan at each step."""

import itertools
import math

import numpy as np
from numpy.typing import NDArray
from tests.navigation.house import bearings, house_map, ranges_at

Pose = tuple[float, float, float]
CORNERS = ((0.6, 1.0), (0.6, 3.0), (5.0, 3.0), (5.0, 1.0), (4.4, 3.0), (2.0, 3.0), (2.0, 1.0), (0.6, 1.0))
"""Through the door and back [m]."""


def smooth_drive(step_m: float = 0.06, step_rad: float = 0.12) -> list[Pose]:
    """Poses of a robot that turns on the spot and drives straight."""
    poses = [(*CORNERS[0], math.pi / 2)]
    for (x, y), (goal_x, goal_y) in itertools.pairwise(CORNERS):
        yaw = poses[-1][2]
        turn = math.remainder(math.atan2(goal_y - y, goal_x - x) - yaw, math.tau)
        count = math.ceil(abs(turn) / step_rad)
        poses += [(x, y, yaw + turn * i / count) for i in range(1, count + 1)]
        length = math.hypot(goal_x - x, goal_y - y)
        count = math.ceil(length / step_m)
        across, along = (goal_x - x) / count, (goal_y - y) / count
        poses += [(x + across * i, y + along * i, yaw + turn) for i in range(1, count + 1)]
    return poses


def relative(pose: Pose, start: Pose) -> Pose:
    """Return a pose in the frame of the start."""
    dx, dy, c, s = pose[0] - start[0], pose[1] - start[1], math.cos(start[2]), math.sin(start[2])
    return c * dx + s * dy, c * dy - s * dx, math.remainder(pose[2] - start[2], math.tau)


def scans(poses: list[Pose], noise_m: float = 0.01) -> list[NDArray[np.float64]]:
    """Ranges at each pose [m]."""
    world, random = house_map(), np.random.default_rng(1)
    return [ranges_at(world, pose) + random.normal(0.0, noise_m, len(bearings())) for pose in poses]


def ends(ranges: NDArray[np.float64]) -> NDArray[np.float64]:
    """Ends of the beams in the laser's frame (n, 2) [m]."""
    return np.stack([ranges * np.cos(bearings()), ranges * np.sin(bearings())], axis=1)
