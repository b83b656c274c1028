"""Frontiers of small costmaps."""

import numpy as np
import pytest

from trundle.navigation.costmap import LETHAL, NO_INFORMATION, BoundedExploreLayer, Bounds, Costmap
from trundle.navigation.costmap.bounded_explore_layer import BoundedExploreSettings
from trundle.navigation.exploration.frontier import find_frontiers, is_inside

SIGNS = {".": 0, "#": LETHAL, "?": NO_INFORMATION, "o": 100}


def costmap(*rows: str) -> Costmap:
    """Cells of 0.5 m from (-1, -1) on, the first row at the top."""
    grid = Costmap(len(rows[0]), len(rows), 0.5, (-1.0, -1.0))
    grid.cells = np.array([[SIGNS[sign] for sign in row] for row in reversed(rows)], dtype=np.uint8)
    return grid


ROOMS = costmap(
    "??????????",
    "#####?####",
    "#....?...#",
    "#.##.#.?.#",
    "#.#....#.#",
    "##########",
)


def test_frontiers_are_unknown_cells_beside_reachable_free_ones() -> None:
    found = find_frontiers(ROOMS, (-0.25, 0.75))
    cells = [
        sorted(map(tuple, ((frontier.points + 1.0) / 0.5 - 0.5).round().astype(int).tolist())) for frontier in found
    ]
    assert cells == [[(5, 3)], [(7, 2)]]
    gap = found[0]
    assert gap.centroid == gap.middle == gap.initial == pytest.approx((1.75, 0.75))
    assert gap.distance_m == pytest.approx(2.0)
    assert find_frontiers(ROOMS, (-0.25, 0.75), min_size_m=0.6) == []


def test_a_frontier_behind_a_wall_is_none_and_far_away_there_are_none() -> None:
    closed = costmap("?????", "#####", "#...#", "#####", "..???")
    assert find_frontiers(closed, (-0.25, 0.25)) == []
    assert find_frontiers(closed, (50.0, 0.0)) == []
    assert find_frontiers(costmap("##", "##"), (-0.75, -0.75)) == []


def test_from_an_inflated_cell_the_search_begins_at_the_nearest_free_one() -> None:
    (frontier,) = find_frontiers(costmap("oo.?", "oo.?", "oo.?"), (-0.75, -0.75))
    assert frontier.size == 3
    assert frontier.centroid == pytest.approx((0.75, -0.25))
    assert frontier.middle == pytest.approx((0.75, -0.75))


def test_frontiers_do_not_depend_on_the_run() -> None:
    random = np.random.default_rng(1)
    grid = Costmap(120, 80, 0.05, (0.0, 0.0))
    grid.cells = random.choice(np.array([0, LETHAL, NO_INFORMATION], dtype=np.uint8), (80, 120), p=[0.8, 0.05, 0.15])
    first, second = (find_frontiers(grid, (3.0, 2.0)) for _ in range(2))
    assert len(first) > 20
    assert [f.points.tobytes() for f in first] == [f.points.tobytes() for f in second]


def test_a_boundary_closes_the_costmap() -> None:
    grid = Costmap(40, 40, 0.1, (0.0, 0.0))
    layer = BoundedExploreLayer("boundary", grid, BoundedExploreSettings(resize_to_boundary=False))
    layer.options.explore_clear_space = False
    layer.set_boundary(np.array([[1.05, 1.05], [3.05, 1.05], [3.05, 3.05]]))
    grid.cells[:, 25:] = NO_INFORMATION
    bounds = Bounds()
    layer.update_bounds((0.0, 0.0, 0.0), bounds)
    layer.update_costs(grid, bounds.window(grid))
    assert grid.cells[10, 10] == grid.cells[30, 30] == grid.cells[20, 20] == LETHAL
    inside = [f.points for f in find_frontiers(grid, (2.0, 1.3))]
    assert all(is_inside(np.array([[1.0, 1.0], [3.1, 1.0], [3.1, 3.1]]), x, y) for points in inside for x, y in points)
    assert inside
    layer.reset()
    assert layer.enabled


def test_a_costmap_takes_the_size_of_its_boundary_within_limits() -> None:
    grid = Costmap(10, 10, 0.1, (0.0, 0.0))
    layer = BoundedExploreLayer("boundary", grid, BoundedExploreSettings())
    layer.set_boundary(np.array([[-5.0, -2.0], [5.0, -2.0], [5.0, 2.0]]))
    assert (grid.width, grid.height) == (102, 42)
    assert grid.origin == pytest.approx((-5.1, -2.1))
    with pytest.raises(ValueError, match="exceeds the limit"):
        layer.set_boundary(np.array([[0.0, 0.0], [1e6, 0.0], [1e6, 1e6]]))
    with pytest.raises(ValueError, match="finite"):
        layer.set_boundary(np.array([[0.0, np.nan]]))
