"""Trajectory rollout's velocities on a free costmap."""

import logging
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from trundle.navigation.costmap import Costmap
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


@pytest.mark.parametrize("x", [0.0, 0.01, 0.02, 0.03, 0.04])
def test_the_fastest_of_the_velocities_that_end_in_one_cell_is_commanded(
    monkeypatch: pytest.MonkeyPatch, x: float
) -> None:
    """Samples are 0.01 m/s apart, ends 0.015 m, and cells are 0.05 m."""
    monkeypatch.setattr("trundle.navigation.planners.trajectory_planner.reconfigure", lambda *_: None)
    log = logging.getLogger("rollout")
    node: Any = SimpleNamespace(
        name="/move_base", log=SimpleNamespace(warn=log.warning, error=log.error), advertise=lambda *_, **__: None
    )
    costmap: Any = SimpleNamespace(
        costmap=Costmap(120, 120, 0.05, (-3.0, -3.0)), footprint=np.empty((0, 2)), frame="odom"
    )
    odometry: Any = SimpleNamespace(velocity=(0.26, 0.0, 0.0))
    section = RosParameters(_TURTLEBOT, "/move_base/TrajectoryPlannerROS")
    root = RosParameters({"controller_frequency": 10.0}, "/move_base")
    buffer: Any = None
    planner = TrajectoryPlannerROS(node, "TrajectoryPlannerROS", section, root, costmap, buffer, odometry)
    lengths = np.linspace(0.0, 2.0, 41)

    velocity = planner.best(Pose2D(x, 0.0, 0.0), np.stack([x + lengths, 0.0 * lengths, 0.0 * lengths], axis=1))

    assert velocity is not None
    assert velocity[0] == pytest.approx(0.26)
