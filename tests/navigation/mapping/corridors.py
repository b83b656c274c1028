"""A ring of corridors, 60 m around, and a drive through it with an odometry that slips."""

import itertools
import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from trundle.navigation.localization._localization import OccupancyMap

RESOLUTION = 0.05
SIDE = 15.0
"""Between the middles of opposite corridors [m]."""
WIDTH = 2.0
RANGE_MAX = 4.0
"""Too short to see the end of a corridor from its middle [m]."""
BEAMS = 120
STEP = 0.2
"""Way or turn between two scans [m], [rad]."""
SLIP = (1.05, 0.96, 0.95, 1.04)
"""Measured by true length in each corridor: the floors differ."""
_NOISE = 0.01
"""[m]"""
Pose = tuple[float, float, float]


class Drive(NamedTuple):
    """What a robot measures on its way."""

    poses: list[Pose]
    """True ones: x, y [m], yaw [rad]; the first is (0, 0, 0)."""
    odometry: list[Pose]
    hits: list[NDArray[np.float64]]
    """(n, 2) of each scan, on the robot [m]."""
    misses: list[NDArray[np.float64]]


def corridor_map() -> OccupancyMap:
    """The ring, with its lower left corridor crossing in (0, 0); niches in its corners differ from each other."""
    half = round(WIDTH / 2.0 / RESOLUTION)
    margin = 20
    count = round(SIDE / RESOLUTION) + 2 * (half + margin)
    cells = np.full((count, count), 100, dtype=np.int8)
    first, last = margin, count - margin
    cells[first:last, first:last] = 0
    cells[first + 2 * half : last - 2 * half, first + 2 * half : last - 2 * half] = 100
    cells[first + 3 : first + 9, first - 8 : first] = 0
    cells[first + 20 : first + 36, last : last + 6] = 0
    cells[last - 12 : last - 6, last : last + 12] = 0
    cells[last : last + 9, first + 16 : first + 24] = 0
    origin = -(half + margin) * RESOLUTION
    return OccupancyMap(cells, resolution=RESOLUTION, x=origin, y=origin)


def true_poses(laps: float = 1.03) -> list[Pose]:
    """Poses along the ring, counterclockwise from its corner, a bit more than once around."""
    corners = [(0.0, 0.0), (SIDE, 0.0), (SIDE, SIDE), (0.0, SIDE)]
    poses: list[Pose] = [(0.0, 0.0, 0.0)]
    left = laps * 4.0 * SIDE
    for number in range(math.ceil(4.0 * laps)):
        (x, y), yaw = corners[number % 4], number % 4 * math.pi / 2.0
        length = min(SIDE, left)
        left -= length
        count = round(length / STEP)
        poses += [
            (x + i * STEP * round(math.cos(yaw)), y + i * STEP * round(math.sin(yaw)), yaw) for i in range(1, count + 1)
        ]
        if left > 0.0:
            end_x, end_y, _ = poses[-1]
            turns = math.ceil(math.pi / 2.0 / STEP)
            poses += [(end_x, end_y, yaw + math.pi / 2.0 * i / turns) for i in range(1, turns + 1)]
    return poses


def slipping(poses: list[Pose]) -> list[Pose]:
    """Odometry of wheels that slip in each corridor differently, and turn 2 % too little."""
    odometry = [poses[0]]
    for last, pose in itertools.pairwise(poses):
        corridor = round(last[2] / (math.pi / 2.0)) % 4
        length = math.hypot(pose[0] - last[0], pose[1] - last[1]) * SLIP[corridor]
        x, y, yaw = odometry[-1]
        yaw += 0.98 * math.remainder(pose[2] - last[2], math.tau)
        odometry.append((x + length * math.cos(yaw), y + length * math.sin(yaw), yaw))
    return odometry


def measure(world: OccupancyMap, poses: list[Pose], odometry: list[Pose], range_max: float = RANGE_MAX) -> Drive:
    """Measure a noisy scan at each pose."""
    random = np.random.default_rng(1)
    bearings = np.arange(BEAMS) * (math.tau / BEAMS)
    directions = np.stack([np.cos(bearings), np.sin(bearings)], axis=1)
    hits: list[NDArray[np.float64]] = []
    misses: list[NDArray[np.float64]] = []
    for x, y, yaw in poses:
        ranges = np.array([world.cast_ray(x, y, yaw + bearing, range_max) for bearing in bearings.tolist()])
        is_hit = ranges < range_max
        noisy = ranges + random.normal(0.0, _NOISE, BEAMS)
        hits.append(noisy[is_hit, None] * directions[is_hit])
        misses.append(range_max * directions[~is_hit])
    return Drive(poses, odometry, hits, misses)


def drive() -> Drive:
    """Drive through the ring."""
    poses = true_poses()
    return measure(corridor_map(), poses, slipping(poses))


def twin_rooms() -> Drive:
    """Drive 6 m through a passage with niches, from a room to one that looks the same; the range is 1.5 m."""
    cells = np.full((60, 200), 100, dtype=np.int8)
    cells[25:35, 30:170] = 0
    for room in (20, 140):
        cells[15:45, room : room + 30] = 0
        cells[20:26, room + 4 : room + 8] = 100
        cells[38:45, room + 18 : room + 30] = 100
    for number, column in enumerate((55, 62, 70, 81, 88, 99, 105, 118, 127)):
        cells[25 - 3 - number % 3 : 25, column : column + 3 + number % 2] = 0
        cells[35 : 37 + number % 4, column + 2 : column + 5] = 0
    world = OccupancyMap(cells, resolution=RESOLUTION, x=-1.75, y=-1.5)
    poses: list[Pose] = [(0.1 * i, 0.0, 0.0) for i in range(68)]
    return measure(world, poses, poses, range_max=1.5)
