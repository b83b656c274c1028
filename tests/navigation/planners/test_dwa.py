"""DWA's velocities on a free costmap."""

import logging
import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from trundle.navigation.costmap import Costmap
from trundle.navigation.planners import Pose2D
from trundle.navigation.planners.dwa_planner import DWAPlannerROS
from trundle.robots.parameters import RosParameters

_LIMITS = {"max_vel_y": 0.0, "min_vel_y": 0.0, "vy_samples": 0, "sim_time": 2.0, "vx_samples": 8}


@pytest.fixture(autouse=True)
def _no_reconfigure(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("trundle.navigation.planners.dwa_planner.reconfigure", lambda *_: None)


def _planner(**parameters: Any) -> DWAPlannerROS:
    """Return a planner at rest on 6 m × 6 m around the origin."""
    log = logging.getLogger("dwa")
    node: Any = SimpleNamespace(
        name="/move_base", log=SimpleNamespace(warn=log.warning, error=log.error), advertise=lambda *_, **__: None
    )
    costmap: Any = SimpleNamespace(
        costmap=Costmap(120, 120, 0.05, (-3.0, -3.0)), footprint=np.empty((0, 2)), frame="odom"
    )
    odometry: Any = SimpleNamespace(velocity=(0.0, 0.0, 0.0))
    section = RosParameters({**_LIMITS, **parameters}, "/move_base/DWAPlannerROS")
    root = RosParameters({"controller_frequency": 10.0}, "/move_base")
    buffer: Any = None
    return DWAPlannerROS(node, "DWAPlannerROS", section, root, costmap, buffer, odometry)


def _way(direction: float) -> NDArray[np.float64]:
    lengths = np.linspace(0.0, 2.0, 41)
    return np.stack([lengths * math.cos(direction), lengths * math.sin(direction), np.full(41, direction)], axis=1)


def test_the_robot_drives_straight_along_a_straight_way() -> None:
    velocity = _planner().best(Pose2D(0.0, 0.0, 0.0), _way(0.0))
    assert velocity is not None
    assert velocity[0] > 0.2
    assert abs(velocity[2]) < 0.1


def test_names_before_melodic_set_the_limits() -> None:
    planner = _planner(max_trans_vel=0.3, max_rot_vel=2.0, max_vel_x=0.5)
    assert planner.speed_limits == (0.3, 2.0)
    planner.speed_limits = (0.05, 0.4)
    velocity = planner.best(Pose2D(0.0, 0.0, 0.0), _way(0.0))
    assert velocity is None or abs(velocity[0]) <= 0.05 + 1e-3


@pytest.mark.parametrize("direction", [0.4, 1.2, 2.0, -2.0])
def test_a_car_never_turns_tighter_than_its_radius(direction: float) -> None:
    car, robot = _planner(min_turning_radius=0.6), _planner()
    assert (car.turns_first, robot.turns_first) == (False, True)

    velocity = car.best(Pose2D(0.0, 0.0, 0.0), _way(direction))
    assert velocity is not None
    assert velocity[0] > 0.0
    assert 0.0 < velocity[2] * math.copysign(1.0, direction) <= velocity[0] / 0.6 + 1e-9


@pytest.mark.parametrize(("names", "drives"), [(("max_trans_vel", "max_rot_vel"), True), ((), False)])
def test_with_names_before_melodic_occdist_scale_has_its_weight_of_that_time(
    names: tuple[str, ...], drives: bool
) -> None:
    """TurtleBot 2's weights, on a way where the costs rise by 20 each cell."""
    weights = {"path_distance_bias": 64.0, "goal_distance_bias": 24.0, "occdist_scale": 0.5}
    planner = _planner(**weights, **dict.fromkeys(names, 0.5))
    planner.costmap.costmap.cells[:] = np.clip(20 * (np.arange(120) - 60), 0, 200).astype(np.uint8)

    velocity = planner.best(Pose2D(0.0, 0.0, 0.0), _way(0.0)[:9])

    assert (velocity is not None and velocity[0] > 0.05) == drives
