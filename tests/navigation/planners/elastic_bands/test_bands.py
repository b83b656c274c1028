"""The optimization of bands, distances of robots' bodies, paths on other sides of obstacles."""

import math

import numpy as np
import pytest
from numpy.typing import NDArray
from tests.navigation.planners.elastic_bands.closed_loop import inflated

from trundle.navigation.planners.elastic_bands import _bands
from trundle.navigation.planners.elastic_bands.homotopy import islands_near, path_around, signature
from trundle.navigation.planners.elastic_bands.teb_settings import read_body
from trundle.robots.parameters import ParamError, RosParameters

_NONE = np.empty((0, 2))
_POINT = _bands.RobotBody(np.zeros((1, 5)), is_closed=False)


def _straight(length_m: float) -> NDArray[np.float64]:
    x = np.linspace(0.0, length_m, 11)
    return np.stack([x, 0.0 * x, 0.0 * x], axis=1)


def _settings(**own: float) -> _bands.BandSettings:
    settings = _bands.BandSettings()
    for name, value in own.items():
        setattr(settings, name, value)
    return settings


def _optimized(path: NDArray[np.float64], settings: _bands.BandSettings, obstacles: NDArray[np.float64] = _NONE):
    band = _bands.TimedBand()
    band.set_path(path, settings)
    costs = [band.optimize(settings, _POINT, obstacles, _NONE, velocity=(0.0, 0.0, 0.0)) for _ in range(8)]
    return band, costs


def test_a_free_way_takes_hardly_longer_than_the_limits_ask() -> None:
    """Length / speed, and up to v / a for the ends. Heavier weights make the limits hard."""
    weights = {"weight_max_vel_x": 1000.0, "weight_acc_lim_x": 1000.0}
    settings = _settings(max_vel_x=0.5, acc_lim_x=0.5, penalty_epsilon=0.0, weight_optimaltime=0.1, **weights)

    band, costs = _optimized(_straight(3.0), settings)

    speeds = np.hypot(*np.diff(band.poses[:, :2], axis=0).T) / band.steps
    accelerations = np.diff(speeds) / (0.5 * (band.steps[1:] + band.steps[:-1]))
    assert 3.0 / 0.5 < band.steps.sum() < 3.0 / 0.5 + 0.5 / 0.5
    assert speeds.max() == pytest.approx(0.5, rel=0.1)
    assert np.abs(accelerations).max() == pytest.approx(0.5, rel=0.1)
    assert costs[-1] <= costs[0]


def test_a_band_keeps_its_distance_from_an_obstacle() -> None:
    obstacle = np.array([[1.5, 0.02]])

    band, _ = _optimized(_straight(3.0), _settings(min_obstacle_dist=0.4, inflation_dist=0.4), obstacle)

    assert np.hypot(*(band.poses[:, :2] - obstacle).T).min() > 0.35
    assert band.poses[[0, -1]].tolist() == [[0.0, 0.0, 0.0], [3.0, 0.0, 0.0]]


def test_a_robot_on_wheels_moves_along_its_heading() -> None:
    path = np.array([[0.0, 0.0, 0.0], [0.5, 0.5, 0.7], [1.0, 1.0, 0.0]])

    band, _ = _optimized(path, _settings(max_vel_theta=1.0))

    step = np.diff(band.poses, axis=0)
    middle = band.poses[:-1, 2] + 0.5 * step[:, 2]
    across = np.cos(middle) * step[:, 1] - np.sin(middle) * step[:, 0]
    assert np.abs(across).max() < 0.01


@pytest.mark.parametrize(
    ("model", "point", "expected"),
    [
        ({}, (3.0, 4.0), 5.0),
        ({"type": "circular", "radius": 0.5}, (3.0, 4.0), 4.5),
        ({"type": "line", "line_start": [-1.0, 0.0], "line_end": [1.0, 0.0]}, (2.0, 1.0), math.sqrt(2.0)),
        (
            {"type": "two_circles", "front_offset": 1.0, "front_radius": 0.2, "rear_offset": 1.0, "rear_radius": 0.3},
            (-2.0, 0.0),
            0.7,
        ),
        ({"type": "polygon", "vertices": [[1, 1], [-1, 1], [-1, -1], [1, -1]]}, (0.8, 0.0), -0.2),
        ({"type": "costmap_2d"}, (0.0, 3.0), 1.0),
    ],
)
def test_distances_from_footprint_models(model: dict[str, object], point: tuple[float, float], expected: float) -> None:
    square = np.array([[2.0, 2.0], [-2.0, 2.0], [-2.0, -2.0], [2.0, -2.0]])
    body = read_body(RosParameters({"footprint_model": model}, "/teb"), square)
    turned = (1.0 - point[1], 2.0 + point[0])  # the robot stands at 1, 2 and looks along y

    assert body.distance((1.0, 2.0, math.pi / 2), turned) == pytest.approx(expected)


def test_an_unknown_footprint_model_is_refused() -> None:
    with pytest.raises(ParamError, match="no footprint model 'blob'; there are: point, circular"):
        read_body(RosParameters({"footprint_model": {"type": "blob"}}, "/teb"), _NONE)


def test_a_pillar_is_passed_on_both_sides_and_walls_are_not() -> None:
    cells = np.zeros((60, 80), np.int8)
    cells[[0, -1], :] = cells[:, [0, -1]] = 100
    cells[26:32, 36:44] = 100
    grid = inflated(cells, 0.2)
    x = np.linspace(0.5, 3.5, 31)
    below = np.stack([x, 1.45 - 0.6 * np.sin((x - 0.5) / 3.0 * math.pi)], axis=1)

    islands = islands_near(grid, below)
    around = path_around(grid, below, islands[0])

    assert len(islands) == 1
    assert around is not None
    assert around[:, 1].max() > 1.8
    assert signature(around, islands) != signature(below, islands)
    assert signature(below[::2], islands) == signature(below, islands)


def test_bubbles_move_away_from_a_wall_and_contract() -> None:
    x = np.linspace(0.0, 2.0, 21)
    path = np.stack([x, 0.1 * np.sin(8.0 * x)], axis=1)
    wall = np.stack([np.linspace(-0.5, 2.5, 61), np.full(61, -0.4)], axis=1)
    settings = _bands.BubbleSettings()
    settings.robot_radius = 0.2

    bubbles = _bands.relax_bubbles(path, wall, settings)

    gaps = np.linalg.norm(bubbles[:, None, :2] - wall, axis=2).min(axis=1)
    assert bubbles[:, 2] == pytest.approx(np.minimum(gaps, 1.2) - 0.2)
    assert bubbles[1:-1, 1].mean() > 0.05
    assert bubbles[[0, -1], :2] == pytest.approx(path[[0, -1]])


def test_no_bubbles_where_the_robot_does_not_fit() -> None:
    path = np.array([[0.0, 0.0], [2.0, 0.0]])
    door = np.array([[1.0, 0.15], [1.0, -0.15]])
    settings = _bands.BubbleSettings()
    settings.robot_radius = 0.2

    assert len(_bands.relax_bubbles(path, door, settings)) == 0


@pytest.mark.parametrize("value", [math.nan, math.inf, 1e7])
def test_numbers_that_are_not_finite_are_refused(value: float) -> None:
    path = _straight(1.0)
    path[3, 1] = value
    with pytest.raises(ValueError, match="finite"):
        _bands.TimedBand().set_path(path, _bands.BandSettings())
    with pytest.raises(ValueError, match="no path"):
        _bands.TimedBand().optimize(_bands.BandSettings(), _POINT, _NONE, _NONE, velocity=(0.0, 0.0, 0.0))
