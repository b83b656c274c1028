"""The front of least cost, and the way down it."""

import math

import numpy as np
import pytest

from trundle.navigation import _grids
from trundle.navigation.planners.navfn import crossing_costs
from trundle.navigation.planners.potential import nearest_reached


def test_distances_on_an_empty_grid_are_nearly_straight() -> None:
    """First-order upwind differences of the eikonal equation err by a few percent, most on diagonals near the seed."""
    potential = _grids.wave_front(np.ones((60, 60), np.float32), [(0, 0)])

    for x, y in ((59, 0), (59, 59), (30, 59)):
        assert potential[y, x] == pytest.approx(math.hypot(x, y), rel=0.05)


def test_a_front_goes_around_walls_and_not_through_them() -> None:
    costs = np.ones((9, 9), np.float32)
    costs[:8, 4] = 0.0
    potential = _grids.wave_front(costs, [(0, 0)])

    assert potential[0, 8] > 2 * 8 + 0.8 * 8 * 0.5
    assert potential[0, 4] == np.float32(_grids.UNREACHED)


def test_a_way_descends_around_a_wall_to_the_seed() -> None:
    costs = np.ones((9, 9), np.float32)
    costs[:8, 4] = 0.0
    potential = _grids.wave_front(costs, [(0, 0)])

    way = _grids.descend(potential, (8, 0), (0, 0))

    assert way[[0, -1]].tolist() == [[8, 0], [0, 0]]
    assert np.hypot(*np.diff(way, axis=0).T).max() <= math.sqrt(2.0)
    assert all(costs[round(y), round(x)] > 0.0 for x, y in way.tolist())
    assert way[:, 1].max() >= 7.5


def test_no_way_leads_out_of_an_enclosure() -> None:
    costs = np.ones((7, 7), np.float32)
    costs[2:5, 2:5] = 0.0
    costs[3, 3] = 1.0
    potential = _grids.wave_front(costs, [(0, 0)])

    assert len(_grids.descend(potential, (3, 3), (0, 0))) == 0
    assert nearest_reached(potential, (3, 3), 1.0) is None
    assert nearest_reached(potential, (3, 3), 2.0) in ((3, 1), (1, 3), (5, 3), (3, 5))


@pytest.mark.parametrize("value", [math.nan, -1.0, math.inf])
def test_cells_of_impossible_costs_block_the_front(value: float) -> None:
    potential = _grids.wave_front(np.array([[1.0, value, 1.0]], np.float32), [(0, 0), (-5, 9)])

    assert potential.tolist() == [[0.0, pytest.approx(_grids.UNREACHED), pytest.approx(_grids.UNREACHED)]]


def test_unknown_cells_are_crossed_only_if_allowed() -> None:
    assert crossing_costs(allow_unknown=True)[255] > 0.0
    assert crossing_costs(allow_unknown=False)[255] == 0.0
    assert crossing_costs(allow_unknown=True)[253:255].tolist() == [0.0, 0.0]
