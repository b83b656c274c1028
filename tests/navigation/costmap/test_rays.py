"""Cells that rays free."""

import math

import numpy as np
import pytest

from trundle.navigation import _grids


def test_a_ray_frees_the_cells_up_to_its_end() -> None:
    cells = np.full((3, 6), 254, np.uint8)

    _grids.clear_rays(cells, (0.5, 1.5), np.array([[3.5, 1.5]]), range=10.0)

    assert cells.tolist() == [[254] * 6, [0, 0, 0, 0, 254, 254], [254] * 6]


def test_a_ray_frees_no_further_than_its_range() -> None:
    cells = np.full((1, 6), 254, np.uint8)

    _grids.clear_rays(cells, (0.5, 0.5), np.array([[5.5, 0.5]]), range=2.0)

    assert cells.tolist() == [[0, 0, 0, 254, 254, 254]]


@pytest.mark.parametrize("end", [(math.nan, 0.5), (math.inf, 0.5), (1e300, -1e300), (-7.0, 40.0)])
def test_a_ray_out_of_the_grid_ends_at_its_border(end: tuple[float, float]) -> None:
    cells = np.full((4, 4), 254, np.uint8)

    _grids.clear_rays(cells, (1.5, 1.5), np.array([end]), range=1e9)

    assert (cells == 254).sum() >= 4 * 4 - 4


def test_a_sensor_outside_the_grid_is_refused() -> None:
    with pytest.raises(ValueError, match="the sensor is outside the grid"):
        _grids.clear_rays(np.zeros((2, 2), np.uint8), (2.5, 0.5), np.zeros((1, 2)), range=1.0)
