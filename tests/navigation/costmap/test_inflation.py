"""Inflation against distances computed one by one."""

import math

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from hypothesis.extra.numpy import arrays

from trundle.navigation import _grids
from trundle.navigation.costmap.inflation_layer import InflationSettings, inflated_costs

_SETTINGS = InflationSettings(inflation_radius=0.3, cost_scaling_factor=5.0)


def test_costs_fall_exponentially_from_the_inscribed_radius() -> None:
    """The formula of costmap_2d: 252 · exp(−factor · (distance − inscribed radius))."""
    costs = inflated_costs(_SETTINGS, 0.1, 0.1)

    assert len(costs) == 3 * 3 + 1
    assert costs[:2] == [254, 253]
    assert costs[4] == int(252 * math.exp(-5.0 * (0.2 - 0.1)))
    assert costs[9] == int(252 * math.exp(-5.0 * (0.3 - 0.1)))


_GRIDS = arrays(
    np.uint8, st.tuples(st.integers(1, 12), st.integers(1, 12)), elements=st.sampled_from([0, 0, 0, 60, 254, 255])
)


@settings(max_examples=40, deadline=None)
@given(_GRIDS, st.booleans())
def test_each_cell_gets_the_cost_of_its_nearest_obstacle(cells: np.ndarray, unknown: bool) -> None:
    costs = inflated_costs(_SETTINGS, 0.1, 0.1)
    height, width = cells.shape
    window = (width // 3, height // 4, width, height)
    expected = cells.copy()
    obstacles = np.argwhere(cells == 254)
    for y in range(window[1], window[3]):
        for x in range(window[0], window[2]):
            squares = [(y - row) ** 2 + (x - column) ** 2 for row, column in obstacles]
            cost = costs[min(squares)] if squares and min(squares) < len(costs) else -1
            if cells[y, x] == 255:
                expected[y, x] = cost if cost > (0 if unknown else 252) else 255
            else:
                expected[y, x] = max(cost, int(cells[y, x]))

    _grids.inflate(cells, window, costs, inflate_unknown=unknown)

    assert cells.tolist() == expected.tolist()


def test_a_window_outside_the_grid_is_refused() -> None:
    with pytest.raises(ValueError, match="the window leaves the grid"):
        _grids.inflate(np.zeros((3, 3), np.uint8), (0, 0, 4, 3), [254, 253], inflate_unknown=False)
