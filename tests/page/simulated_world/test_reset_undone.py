"""A robot whose reset is undone drives on as if it had not been reset."""

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from tests.sim.timeline.test_timeline import PUSH, Driver, seconds, world

import trundle
from trundle.page import ResetModel, UndoReset
from trundle.page.shown_world import BareWorld
from trundle.page.simulated_world.model_edits import ModelEdits
from trundle.ros import GraphLoop
from trundle.sim.simulation import Simulation
from trundle.sim.timeline import Timeline


def test_undoing_a_reset_restores_the_robot_and_its_plugins(tmp_path: Path) -> None:
    """The drive has reached half of the commanded speed; a user's plugin pushes the robot randomly."""
    (tmp_path / "push.py").write_text(PUSH, encoding="utf-8")
    (tmp_path / "robots.world").write_text(world(2), encoding="utf-8")
    with trundle.load(str(tmp_path / "robots.world"), plugins=True, ros=True) as simulation, GraphLoop() as loop:
        timeline = Timeline(simulation, wall_ns=lambda: 0)
        edits = ModelEdits(BareWorld(simulation, timeline=timeline))
        timeline.advance(seconds(0.3))
        Driver(simulation, loop).drive(timeline, 0.5, 0.2)
        now_ns = simulation.time_ns + seconds(0.25)
        timeline.advance(now_ns)
        timeline.advance(now_ns + seconds(1))
        expected = _states(simulation)
        assert simulation["robot0"].pose.position[0] > 0.3

        timeline.seek(now_ns)
        edits.handle(ResetModel("robot0"))
        assert simulation["robot0"].pose.position == pytest.approx((0.0, 0.0, 0.1), abs=1e-9)
        edits.handle(UndoReset("robot0"))
        timeline.advance(now_ns + seconds(1))
        np.testing.assert_allclose(_states(simulation), expected, atol=2e-3)


def _states(simulation: Simulation) -> NDArray[np.float64]:
    """Return position, orientation and velocity of both robots."""
    robots = (simulation["robot0"], simulation["robot1"])
    return np.array([[*robot.pose.position, *robot.pose.quaternion, *robot.twist.linear] for robot in robots])
