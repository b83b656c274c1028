"""Frontiers of a costmap: where free space that the robot can reach ends in unknown space."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .. import _grids
from ..costmap import Costmap

Point = tuple[float, float]
"""x, y [m]"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Frontier:
    """One connected frontier."""

    points: NDArray[np.float64]
    """(n, 2) centers of its cells [m]."""
    distance_m: float
    """Straight distance from the robot to the nearest point [m]."""
    initial: Point
    """The point with the shortest path from the robot."""
    middle: Point
    """The point with the shortest straight distance from the robot."""
    centroid: Point

    @property
    def size(self) -> int:
        """Number of cells."""
        return len(self.points)


def find_frontiers(costmap: Costmap, robot: Point, *, min_size_m: float = 0.0) -> list[Frontier]:
    """Return the frontiers that the robot can reach; none if it is outside the costmap, or no free cell is near.

    Args:
        costmap: costs of costmap_2d.
        robot: place of the robot [m].
        min_size_m: minimum size: number of cells times the size of a cell [m].
    """
    start = costmap.cell(*robot)
    if start is None:
        return []
    cells = _grids.find_frontiers(np.ascontiguousarray(costmap.cells), start)
    if not len(cells):
        return []
    ends = np.flatnonzero(np.diff(cells[:, 0])) + 1
    frontiers: list[Frontier] = []
    for group in np.split(cells, ends):
        if len(group) * costmap.resolution_m < min_size_m:
            continue
        places = (group[:, 1:].astype(np.float64) + 0.5) * costmap.resolution_m
        points = (places + np.array(costmap.origin)).astype(np.float64)
        distances = np.hypot(points[:, 0] - robot[0], points[:, 1] - robot[1])
        nearest = int(distances.argmin())
        frontiers.append(
            Frontier(
                points=points,
                distance_m=float(distances[nearest]),
                initial=_point(points[0]),
                middle=_point(points[nearest]),
                centroid=_point(points.mean(axis=0)),
            )
        )
    return frontiers


def _point(row: NDArray[np.float64]) -> Point:
    return float(row[0]), float(row[1])


def is_inside(polygon: NDArray[np.float64], x: float, y: float) -> bool:
    """Return True if a point is in a polygon (n, 2) [m]."""
    ends = np.roll(polygon, 1, axis=0)
    crosses = (polygon[:, 1] > y) != (ends[:, 1] > y)
    with np.errstate(divide="ignore", invalid="ignore"):
        at = polygon[:, 0] + (ends[:, 0] - polygon[:, 0]) * (y - polygon[:, 1]) / (ends[:, 1] - polygon[:, 1])
    return bool(np.count_nonzero(crosses & (x < at)) % 2)


def near(a: Point, b: Point, distance_m: float) -> bool:
    """Return True if two points are nearer than a distance."""
    return math.dist(a, b) < distance_m
