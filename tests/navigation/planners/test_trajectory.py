"""Trajectory rollout's velocities on a free costmap."""

import logging
from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from trundle.navigation.costmap import LETHAL, Costmap
from trundle.navigation.planners import Pose2D
from trundle.navigation.planners.trajectory_planner import TrajectoryPlannerROS
from trundle.robots.parameters import RosParameters

_TURTLEBOT = {
    "max_vel_x": 0.26,
    "min_vel_x": 0.08,
    "sim_time": 1.5,
    "vx_samples": 18,
    "dwa": False,
    "meter_scoring": True,
    "holonomic_robot": False,
}


@pytest.fixture
def make(monkeypatch: pytest.MonkeyPatch) -> Callable[..., TrajectoryPlannerROS]:
    """Return a function that makes a planner with parameters, a velocity [m/s] and costs of the cells."""
    monkeypatch.setattr("trundle.navigation.planners.trajectory_planner.reconfigure", lambda *_: None)

    def planner(
        parameters: dict[str, Any], speed: float, obstacles: tuple[slice, slice] | None = None
    ) -> TrajectoryPlannerROS:
        log = logging.getLogger("rollout")
        node: Any = SimpleNamespace(
            name="/move_base", log=SimpleNamespace(warn=log.warning, error=log.error), advertise=lambda *_, **__: None
        )
        grid = Costmap(120, 120, 0.05, (-3.0, -3.0))
        if obstacles is not None:
            grid.cells[obstacles] = LETHAL
        square = np.array([[0.2, 0.2], [-0.2, 0.2], [-0.2, -0.2], [0.2, -0.2]])
        footprint = np.empty((0, 2)) if obstacles is None else square
        costmap: Any = SimpleNamespace(costmap=grid, footprint=footprint, frame="odom")
        odometry: Any = SimpleNamespace(velocity=(speed, 0.0, 0.0))
        section = RosParameters(parameters, "/move_base/TrajectoryPlannerROS")
        root = RosParameters({"controller_frequency": 10.0}, "/move_base")
        buffer: Any = None
        return TrajectoryPlannerROS(node, "TrajectoryPlannerROS", section, root, costmap, buffer, odometry)

    return planner


@pytest.mark.parametrize("x", [0.0, 0.01, 0.02, 0.03, 0.04])
def test_the_fastest_of_the_velocities_that_end_in_one_cell_is_commanded(
    make: Callable[..., TrajectoryPlannerROS], x: float
) -> None:
    """Samples are 0.01 m/s apart, ends 0.015 m, and cells are 0.05 m."""
    planner = make(_TURTLEBOT, 0.26)
    lengths = np.linspace(0.0, 2.0, 41)

    velocity = planner.best(Pose2D(x, 0.0, 0.0), np.stack([x + lengths, 0.0 * lengths, 0.0 * lengths], axis=1))

    assert velocity is not None
    assert velocity[0] == pytest.approx(0.26)


def test_a_robot_moves_sideways_only_where_it_can_neither_drive_nor_turn(
    make: Callable[..., TrajectoryPlannerROS],
) -> None:
    """`holonomic_robot` is the default, for robots with two wheels too; the way leads to the left."""
    lengths = np.linspace(0.0, 2.0, 41)
    way = np.stack([0.0 * lengths, lengths, 0.0 * lengths + np.pi / 2], axis=1)
    walls = (slice(None), slice(65, 68))  # 0.25 m to 0.4 m before it, all along

    free = make({}, 0.0).best(Pose2D(0.0, 0.0, 0.0), way)
    shut_in = make({"min_vel_x": 0.3}, 0.0, walls).best(Pose2D(0.0, 0.0, 0.0), way)

    assert free is not None
    assert free[1] == 0.0
    assert shut_in is not None
    assert shut_in[0] == 0.0
    assert shut_in[1] > 0.0
