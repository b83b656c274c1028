"""Robots of three kinds map an office and a flat, find themselves on their maps, and drive to goals in them."""

import math
from pathlib import Path

import numpy as np
import pytest
from tests.navigation.houses.buildings import BUILDINGS
from tests.navigation.houses.tour import Tour

from trundle.gazebo.nodes.map_server.occupancy_grid import read_map

_SUCCEEDED = 3


@pytest.mark.slow
@pytest.mark.parametrize(
    "tour",
    [Tour("office", "car"), Tour("flat", "omni"), Tour("flat", "differential")],
    ids=lambda tour: f"{tour.robot} in the {tour.building}",
)
def test_a_robot_maps_a_building_and_reaches_goals_in_it(tour: Tour, tmp_path: Path) -> None:
    mapped = tour.map(tmp_path)
    assert mapped["contacts"] == []
    known, beside_m = _judge_map(tour, tmp_path / "map.yaml", mapped["world_from_map"])
    assert known > 0.8
    assert beside_m < 0.15

    driven = tour.drive(tmp_path, mapped["world_from_map"])

    assert [goal["state"] for goal in driven["goals"]] == [_SUCCEEDED] * len(BUILDINGS[tour.building].goals)
    assert max(goal["beside_m"] for goal in driven["goals"]) < 0.25
    assert driven["contacts"] == []
    assert driven["error_m"] < 0.15


@pytest.mark.slow
@pytest.mark.parametrize(
    "tour",
    [
        Tour("flat", "differential", planner="eband_local_planner/EBandPlannerROS"),
        Tour("flat", "differential", has_rings=True),
    ],
    ids=["an elastic band", "a lidar of 16 rings"],
)
def test_goals_in_the_flat_are_reached_with(tour: Tour, tmp_path: Path) -> None:
    """The lidar of 16 rings is seen by amcl as scans, and by the costmaps as clouds."""
    driven = tour.drive(tmp_path, tour.draw_map(tmp_path))

    assert [goal["state"] for goal in driven["goals"]] == [_SUCCEEDED] * len(BUILDINGS["flat"].goals)
    assert max(goal["beside_m"] for goal in driven["goals"]) < 0.3
    assert driven["contacts"] == []
    assert driven["error_m"] < 0.15


def _judge_map(tour: Tour, file: Path, world_from_map: list[float]) -> tuple[float, float]:
    """Return the known share of the free floor, and how far 95 % of occupied cells are from a wall, at most [m]."""
    building, (start_x, start_y, yaw) = BUILDINGS[tour.building], world_from_map
    grid = read_map(file)
    rows, columns = np.indices(grid.cells.shape)
    x = (columns + 0.5) * grid.resolution_m + grid.origin[0]
    y = (rows + 0.5) * grid.resolution_m + grid.origin[1]
    c, s = math.cos(yaw), math.sin(yaw)
    points = np.stack([start_x + c * x - s * y, start_y + s * x + c * y], axis=-1)
    occupied = points[grid.cells > 50]
    x0, x1, y0, y1 = building.inside
    floor = np.stack(np.meshgrid(np.arange(x0, x1, 0.1), np.arange(y0, y1, 0.1)), axis=-1).reshape(-1, 2)
    floor = floor[building.distances(floor) > 0.1]
    ahead = floor - (start_x, start_y)
    cells = np.stack([c * ahead[:, 0] + s * ahead[:, 1], c * ahead[:, 1] - s * ahead[:, 0]], axis=-1)
    indices = np.floor((cells - grid.origin[:2]) / grid.resolution_m).astype(int)
    is_on_map = ((indices >= 0) & (indices < grid.cells.shape[::-1])).all(axis=1)
    free = grid.cells[indices[is_on_map, 1], indices[is_on_map, 0]] == 0
    return float(free.sum() / len(floor)), float(np.quantile(building.distances(occupied), 0.95))
