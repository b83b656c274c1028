"""Trajectories, and the terms of their scores."""

import math
from typing import Any

import numpy as np
import pytest

from trundle.navigation import _grids
from trundle.navigation.costmap import circle

_SETTINGS: dict[str, Any] = {"sim_time": 2.0, "granularity": 0.01, "angular_granularity": 0.01}
_NO_FOOTPRINT = np.empty((0, 2))


def _score(costs: np.ndarray, footprint: np.ndarray, target: tuple[float, float, float], **options: Any):
    """Return the terms of one trajectory from the middle of a grid of 0.1 m, whose fields are the column."""
    field = np.tile(np.arange(costs.shape[1], dtype=np.float32), (costs.shape[0], 1))
    maps = _grids.RolloutMaps(costs=costs, path=field, goal=field, front=field, origin=(-1.0, -1.0), resolution=0.1)
    settings = _grids.RolloutSettings(**{**_SETTINGS, **options})
    rows = _grids.score_rollouts(settings, maps, footprint, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), np.array([target]))
    return rows[0].tolist()


def test_a_constant_turn_ends_on_its_circle() -> None:
    settings = _grids.RolloutSettings(**_SETTINGS)

    poses = _grids.roll_out(settings, (1.0, 2.0, 0.0), (0.0, 0.0, 0.0), (0.5, 0.0, math.pi / 4))

    radius = 0.5 / (math.pi / 4)
    assert poses[-1] == pytest.approx((1.0 + radius, 2.0 + radius, math.pi / 2), abs=0.01)


def test_a_robot_that_accelerates_falls_behind() -> None:
    settings = _grids.RolloutSettings(**_SETTINGS, accelerates=True, acceleration=(0.5, 0.5, 0.5))

    poses = _grids.roll_out(settings, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.5, 0.0, 0.0))

    assert poses[-1][0] == pytest.approx(0.5 * 2.0 - 0.5 * 0.5 / (2 * 0.5), abs=0.01)


def test_distances_are_read_at_the_end_and_ahead_of_it() -> None:
    free = np.zeros((20, 20), np.uint8)

    _, path, goal, front, alignment, steps = _score(free, _NO_FOOTPRINT, (0.2, 0.0, 0.0), forward_point=0.3)

    assert (path, goal, front, alignment) == (14.0, 14.0, 17.0, 17.0)
    assert steps == 40.0


def test_the_highest_cost_along_the_way_counts() -> None:
    costs = np.zeros((20, 20), np.uint8)
    costs[:, 12] = 77

    assert _score(costs, _NO_FOOTPRINT, (0.2, 0.0, 0.0))[0] == 77.0


@pytest.mark.parametrize(("cost", "expected"), [(254, -1.0), (255, -2.0), (253, 253.0)])
def test_a_footprint_must_not_touch_lethal_or_unknown_cells(cost: int, expected: float) -> None:
    costs = np.zeros((20, 20), np.uint8)
    costs[:, 15] = cost
    square = np.array([[0.2, 0.2], [0.2, -0.2], [-0.2, -0.2], [-0.2, 0.2]])

    assert _score(costs, square, (0.2, 0.0, 0.0))[0] == expected


def test_a_way_off_the_map_is_invalid() -> None:
    assert _score(np.zeros((20, 20), np.uint8), _NO_FOOTPRINT, (0.6, 0.0, 0.0))[0] == -2.0


def test_grids_of_two_shapes_are_refused() -> None:
    field = np.zeros((2, 2), np.float32)
    with pytest.raises(ValueError, match="the grids have one shape"):
        _grids.RolloutMaps(
            costs=np.zeros((3, 3), np.uint8), path=field, goal=field, front=field, origin=(0.0, 0.0), resolution=0.1
        )


@pytest.mark.parametrize(("row", "expected"), [(10, -1.0), (12, -1.0), (13, 0.0)])
def test_a_round_footprint_collides_where_its_circle_touches_a_lethal_cell(row: int, expected: float) -> None:
    """Its costs are kept for each half cell: the robot of 0.25 m passes a cell that begins 0.3 m beside it."""
    costs = np.zeros((20, 20), np.uint8)
    costs[row, 14] = 254

    assert _score(costs, circle(0.25), (0.3, 0.0, 0.0))[0] == expected


def test_costs_of_a_round_footprint_are_those_of_its_outline() -> None:
    costs = np.tile(np.arange(0, 200, 10, dtype=np.uint8), (20, 1))
    outline = circle(0.25)

    kept = _score(costs, outline, (0.2, 0.0, 0.0))[0]

    assert kept == pytest.approx(_grids.footprint_cost(costs, (-1.0, -1.0), 0.1, outline, (0.4, 0.0, 0.0)), abs=10.0)
