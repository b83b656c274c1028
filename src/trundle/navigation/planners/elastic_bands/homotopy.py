"""Paths that pass the same obstacles on other sides."""

import math

import numpy as np
from numpy.typing import NDArray

from trundle.navigation import _grids

from ...costmap import INSCRIBED, LETHAL, NO_INFORMATION, Costmap
from ._bands import obstacle_islands

_MAX_ISLANDS = 4
"""Number of obstacles that are passed on either side, the nearest to the path."""
Signature = tuple[int, ...]


def islands_near(grid: Costmap, path: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return points (n, 2) [m] in obstacles that may be passed on either side, the nearest to a path (n, 2) first."""
    cells = obstacle_islands(grid.cells)
    points = np.array(grid.origin) + (cells + 0.5) * grid.resolution_m
    distances = np.linalg.norm(points[:, None] - path[:, :2], axis=2).min(axis=1) if len(points) else np.empty(0)
    return points[np.argsort(distances, kind="stable")[:_MAX_ISLANDS]]


def signature(path: NDArray[np.float64], islands: NDArray[np.float64]) -> Signature:
    """Return the whole turns of a path (n, 2 or more) around each island, beyond the angle between its ends.

    Of paths between the same ends, those with the same turns can be deformed into each other.
    """
    turns: list[int] = []
    for island in islands:
        rays = path[:, :2] - island
        angles = np.arctan2(rays[:, 1], rays[:, 0])
        swept = float(np.sum(np.remainder(np.diff(angles) + math.pi, 2.0 * math.pi) - math.pi))
        direct = math.remainder(float(angles[-1] - angles[0]), 2.0 * math.pi)
        turns.append(round((swept - direct) / (2.0 * math.pi)))
    return tuple(turns)


def path_around(grid: Costmap, path: NDArray[np.float64], island: NDArray[np.float64]) -> NDArray[np.float64] | None:
    """Return the shortest path (n, 2) [m] between the ends of one that passes an island on its other side, if any.

    A cut from the island across the path to the grid's edge blocks the path's side.
    """
    ends = grid.cell(*path[0, :2].tolist()), grid.cell(*path[-1, :2].tolist())
    if ends[0] is None or ends[1] is None:
        return None
    costs = np.where((grid.cells < INSCRIBED) | (grid.cells == NO_INFORMATION), 1.0, 0.0).astype(np.float32)
    nearest = path[int(np.linalg.norm(path[:, :2] - island, axis=1).argmin()), :2]
    direction = nearest - island
    norm = float(np.hypot(*direction))
    if norm < 1e-6:
        return None
    reach = math.hypot(grid.width, grid.height) * grid.resolution_m
    lengths = np.arange(0.0, reach, 0.4 * grid.resolution_m)[:, None]
    cut = np.floor(grid.in_cells(island + lengths * direction / norm)).astype(int)
    cut = cut[((cut >= 0) & (cut < np.array([grid.width, grid.height]))).all(axis=1)]
    for dx, dy in ((0, 0), (1, 0), (0, 1)):  # two cells wide, so that no diagonal step crosses it
        costs[np.minimum(cut[:, 1] + dy, grid.height - 1), np.minimum(cut[:, 0] + dx, grid.width - 1)] = 0.0
    for x, y in (ends[0], ends[1]):
        if grid.cells[y, x] == LETHAL:
            return None
        costs[y, x] = 1.0
    potential = _grids.wave_front(costs, [ends[0]], stop=ends[1])
    way = _grids.descend(potential, ends[1], ends[0])
    if len(way) < 3:
        return None
    return np.array(grid.origin) + (way[::-1] + 0.5) * grid.resolution_m
