"""Costs of points, poses and paths, as mbf_costmap_nav's services report them."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..costmap import INSCRIBED, LETHAL, NO_INFORMATION, Costmap, placed

FREE, INSCRIBED_STATE, LETHAL_STATE, UNKNOWN, OUTSIDE = range(5)
"""States of the services, from the least to the worst."""


class Multipliers(NamedTuple):
    """Scales of the costs of cells; 0: the costs as they are."""

    lethal: float = 0.0
    inscribed: float = 0.0
    unknown: float = 0.0


def point_state(grid: Costmap, x: float, y: float) -> tuple[int, int]:
    """Return state and cost of the cell at a point [m]."""
    cell = grid.cell(x, y)
    if cell is None:
        return OUTSIDE, 0
    cost = int(grid.cells[cell[1], cell[0]])
    return _state(cost), cost


def pose_state(
    grid: Costmap, footprint: NDArray[np.float64], pose: tuple[float, float, float], margin_m: float, scale: Multipliers
) -> tuple[int, int]:
    """Return the worst state and the sum of the costs under a footprint (n, 2) [m] at a pose.

    Args:
        grid: costmap.
        footprint: outline in the robot's frame.
        pose: x, y [m], yaw [rad].
        margin_m: distance by which the outline's corners move outwards along both axes.
        scale: scales of the costs.
    """
    outline = placed(footprint + np.sign(footprint) * margin_m, *pose)
    corners = grid.in_cells(outline)
    x0, y0 = int(np.floor(corners[:, 0].min())), int(np.floor(corners[:, 1].min()))
    x1, y1 = int(np.floor(corners[:, 0].max())) + 1, int(np.floor(corners[:, 1].max())) + 1
    if x0 < 0 or y0 < 0 or x1 > grid.width or y1 > grid.height:
        return OUTSIDE, 0
    covered = _inside(corners, np.arange(x0, x1, dtype=float) + 0.5, np.arange(y0, y1, dtype=float)[:, None] + 0.5)
    for x, y in np.floor(corners).astype(int).tolist():  # a thin outline covers no center of a cell
        covered[y - y0, x - x0] = True
    costs = grid.cells[y0:y1, x0:x1][covered]
    return _worst(costs), _sum(costs, scale)


def path_cells_state(grid: Costmap, path: NDArray[np.float64], scale: Multipliers) -> tuple[int, int]:
    """Return the worst state and the sum of the costs of the cells at points (n, 2) [m]."""
    cells = np.floor(grid.in_cells(path[:, :2])).astype(int)
    if ((cells < 0) | (cells >= np.array([grid.width, grid.height]))).any():
        return OUTSIDE, 0
    cells = np.unique(cells, axis=0)
    costs = grid.cells[cells[:, 1], cells[:, 0]]
    return _worst(costs), _sum(costs, scale)


def _state(cost: int) -> int:
    states = {NO_INFORMATION: UNKNOWN, LETHAL: LETHAL_STATE, INSCRIBED: INSCRIBED_STATE}
    return states.get(cost, FREE)


def _worst(costs: NDArray[np.uint8]) -> int:
    return max((_state(int(cost)) for cost in np.unique(costs)), default=FREE)


def _sum(costs: NDArray[np.uint8], scale: Multipliers) -> int:
    scaled = costs.astype(np.float64)
    for cost, factor in ((LETHAL, scale.lethal), (INSCRIBED, scale.inscribed), (NO_INFORMATION, scale.unknown)):
        if factor > 0.0:
            scaled[costs == cost] *= factor
    return int(min(scaled.sum(), 2**32 - 1))


def _inside(corners: NDArray[np.float64], x: NDArray[np.float64], y: NDArray[np.float64]) -> NDArray[np.bool_]:
    """True for the points of columns x (w,) and rows y (h, 1) inside a polygon (n, 2), by the even-odd rule."""
    inside = np.zeros((len(y), len(x)), dtype=bool)
    for (x0, y0), (x1, y1) in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        if y0 != y1:
            inside ^= ((y0 > y) != (y1 > y)) & (x < x0 + (x1 - x0) * (y - y0) / (y1 - y0))
    return inside
