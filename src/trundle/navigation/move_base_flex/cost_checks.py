"""Costs of points, poses and paths, as mbf_costmap_nav's services report them."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..costmap import INSCRIBED, LETHAL, NO_INFORMATION, Costmap, placed

FREE, INSCRIBED_STATE, LETHAL_STATE, UNKNOWN, OUTSIDE = range(5)
"""States of the services, from the least to the worst."""
_USABLE = (FREE, INSCRIBED_STATE, UNKNOWN, OUTSIDE)
"""States of poses that may be found, from the best."""
_TURN_STEP = math.radians(5.0)
_MAX_PLACES = 100_000


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


def find_pose(
    grid: Costmap,
    footprint: NDArray[np.float64],
    pose: tuple[float, float, float],
    margin_m: float,
    *,
    reach_m: float,
    turn: float,
) -> tuple[int, int, tuple[float, float, float]]:
    """Return state, cost and pose of the free place that is nearest to a pose; of those, that with the smallest turn.

    Without a free one, the nearest is returned whose footprint is in inscribed cells, else in unknown ones, else partly
    outside; without any, the state is LETHAL_STATE and the pose that which was given.

    Args:
        grid: costmap; places are a cell apart.
        footprint: outline (n, 2) in the robot's frame [m].
        pose: x, y [m], yaw [rad].
        margin_m: see `pose_state`.
        reach_m: greatest distance to the pose [m].
        turn: greatest turn from it [rad].
    """
    x, y, yaw = pose
    count = min(int(reach_m / grid.resolution_m), int(math.sqrt(_MAX_PLACES) / 2))
    steps = np.arange(-count, count + 1) * grid.resolution_m
    places = np.stack(np.meshgrid(steps, steps), axis=-1).reshape(-1, 2)
    distances = np.hypot(places[:, 0], places[:, 1])
    order = np.argsort(distances, kind="stable")
    turns = np.append(np.arange(0.0, min(turn, math.pi), _TURN_STEP), min(turn, math.pi))
    yaws = yaw + np.unique(np.concatenate([turns, -turns]))
    yaws = yaws[np.argsort(np.abs(yaws - yaw), kind="stable")].tolist()
    found: dict[int, tuple[int, tuple[float, float, float]]] = {}
    for dx, dy in places[order[distances[order] <= reach_m + 1e-9]].tolist():
        center, _ = point_state(grid, x + dx, y + dy)
        if center in (INSCRIBED_STATE, LETHAL_STATE) or center in found:
            continue
        for angle in yaws:
            place = (x + dx, y + dy, angle)
            state, cost = pose_state(grid, footprint, place, margin_m, Multipliers())
            if state == FREE:
                return state, cost, place
            found.setdefault(state, (cost, place))
    state = next((state for state in _USABLE if state in found), LETHAL_STATE)
    return state, *found.get(state, (0, pose))


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
