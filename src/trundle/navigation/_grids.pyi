"""Loops over the cells of costmaps, in C++; none holds the GIL. Grids are (height, width), row 0 at the smallest y."""

from collections.abc import Sequence
from typing import Any, TypeAlias

from numpy import float32, float64, int32, uint8, uint32
from numpy.typing import NDArray

UNREACHED: float
"""Potential of cells that no path reaches."""
_Triple: TypeAlias = tuple[float, float, float]

def inflate(
    cells: NDArray[uint8], window: tuple[int, int, int, int], costs: Sequence[int], *, inflate_unknown: bool
) -> None:
    """Raise the costs in a window by the exact distance to the nearest lethal cell, inside the window or outside.

    Args:
        cells: costs, changed in place.
        window: x0, y0, x1, y1 in cells; x1 and y1 are past the end.
        costs: cost for each squared distance in cells, from 0 up to the squared radius.
        inflate_unknown: True: any cost replaces unknown cells; False: only inscribed and lethal ones.
    """

def clear_rays(cells: NDArray[uint8], sensor: tuple[float, float], ends: NDArray[float64], *, range: float) -> None:
    """Free the cells along rays, as far as `range`.

    Args:
        cells: costs, changed in place.
        sensor: x, y in cells; (0, 0) is the outer corner of the first one.
        ends: (n, 2) ends of the rays, in cells.
        range: greatest length that is freed, in cells.

    Raises:
        ValueError: the sensor is outside the grid.
    """

def clear_voxel_rays(
    voxels: NDArray[uint32],
    cells: NDArray[uint8],
    sensor: _Triple,
    ends: NDArray[float64],
    *,
    levels: int,
    unknown_threshold: int,
    mark_threshold: int,
) -> None:
    """Free the voxels along rays, and the cells of columns that have no obstacle any more.

    Args:
        voxels: columns, changed in place: bits 0 … 15 unknown or occupied levels, 16 … 31 occupied ones.
        cells: costs, changed in place: free, or unknown with more than `unknown_threshold` unknown levels.
        sensor: x, y, level; (0, 0, 0) is the outer corner of the first voxel.
        ends: (n, 3) ends of the rays, as `sensor`.
        levels: number of levels, at most 16.
        unknown_threshold: greatest number of unknown levels of a free column.
        mark_threshold: greatest number of occupied levels of a column without an obstacle.
    """

def wave_front(
    costs: NDArray[float32], seeds: Sequence[tuple[int, int]], *, stop: tuple[int, int] = (-1, -1)
) -> NDArray[float32]:
    """Return the cost of the cheapest path from any seed to each cell, by the eikonal equation.

    Args:
        costs: cost of crossing a cell; not positive or ≥ UNREACHED: impassable.
        seeds: cells (x, y) of potential 0; those outside are left out.
        stop: the front ends once it has passed this cell; outside the grid: it reaches every cell.
    """

def descend(potential: NDArray[float32], start: tuple[int, int], end: tuple[int, int]) -> NDArray[float64]:
    """Return the steepest descent (n, 2) from a cell to a seed, in cells from the first cell's center; empty: none."""

def find_frontiers(costs: NDArray[uint8], start: tuple[int, int]) -> NDArray[int32]:
    """Return the cells (n, 3) of frontiers: number of the frontier, column, row.

    A frontier's cells are unknown, touch each other, and lie beside free cells; at least one of these is connected
    with the start. Frontiers are sorted by the length of the path to them.
    """

class RolloutSettings:
    """How trajectories are simulated, and at which point their alignment is measured."""

    def __init__(
        self,
        *,
        sim_time: float,
        granularity: float,
        angular_granularity: float,
        forward_point: float = 0.0,
        acceleration: _Triple = (0.0, 0.0, 0.0),
        accelerates: bool = False,
        sums_costs: bool = False,
    ) -> None:
        """Take the settings of a planner.

        Args:
            sim_time: length of a trajectory [s].
            granularity: distance of two points [m].
            angular_granularity: angle between two points [rad].
            forward_point: point ahead of the center, where the alignment is measured [m].
            acceleration: limits of x, y [m/s²] and yaw [rad/s²].
            accelerates: True: the robot accelerates to the sample's velocity within the limits; False: it has that
                velocity at once.
            sums_costs: True: costs of obstacles add up along the trajectory; False: the highest counts.
        """

class RolloutMaps:
    """Grids in which trajectories are scored; the arrays must not change while this object is used."""

    def __init__(
        self,
        *,
        costs: NDArray[uint8],
        path: NDArray[float32],
        goal: NDArray[float32],
        front: NDArray[float32],
        origin: tuple[float, float],
        resolution: float,
    ) -> None:
        """Take grids of one shape: costs, and distances in cells to the path, its end, and a point beyond its end."""

def score_rollouts(
    settings: RolloutSettings,
    maps: RolloutMaps,
    footprint: NDArray[float64],
    pose: _Triple,
    velocity: _Triple,
    targets: NDArray[float64],
) -> NDArray[float64]:
    """Return the terms (n, 6) of trajectories: obstacles, path, goal, front, alignment, number of points.

    Obstacles: a cost of costmap_2d, −1 in a collision, −2 off the map or in unknown space. Path, goal, front and
    alignment: distances at the trajectory's end, in cells.

    Args:
        settings: see `RolloutSettings`.
        maps: see `RolloutMaps`.
        footprint: (n, 2) polygon around the robot's origin [m]; fewer than three points: only the origin's cell.
        pose: x, y [m] and yaw [rad] now.
        velocity: velocity now, in the robot's frame [m/s], [rad/s].
        targets: (n, 3) velocities of the samples.
    """

def roll_out(settings: RolloutSettings, pose: _Triple, velocity: _Triple, target: _Triple) -> list[Any]:
    """Return the poses of one trajectory."""

def footprint_cost(
    costs: NDArray[uint8],
    origin: tuple[float, float],
    resolution: float,
    footprint: NDArray[float64],
    pose: _Triple,
) -> float:
    """Return the highest cost under a footprint's edges and its center; negative as in `score_rollouts`."""
