"""yocs_velocity_smoother, the nodelet that limits a TurtleBot 2's accelerations."""

from itertools import pairwise
from typing import Any

import pytest
from tests.gazebo.nodes.conftest import PATIENCE_S

_TWIST = "geometry_msgs/Twist"
_LOAD = "load yocs_velocity_smoother/VelocitySmootherNodelet manager"
_LIMITS = {"speed_lim_v": 0.5, "speed_lim_w": 2.0, "accel_lim_v": 1.0, "accel_lim_w": 2.0, "decel_factor": 2.0}


def _command(graph: Any, publisher: Any, speed: float, turn: float, condition: Any) -> None:
    """Publish a command until a condition is true."""

    def is_true() -> bool:
        publisher.publish({"linear": {"x": speed}, "angular": {"z": turn}})
        return bool(condition())

    graph.until(is_true)


def test_commands_rise_in_steps_that_both_axes_can_make_and_end_when_the_input_is_silent(graph: Any) -> None:
    graph.start("nodelet/nodelet", _LOAD, name="smoother", frequency=50.0, **_LIMITS)
    messages = graph.listen("/smoother/smooth_cmd_vel", _TWIST)
    raw = graph.advertise("/smoother/raw_cmd_vel", _TWIST)
    graph.until(lambda: graph.connected("/smoother/smooth_cmd_vel"))
    _command(graph, raw, 0.8, 0.25, lambda: messages and messages[-1].linear.x == 0.5)

    speeds = [message.linear.x for message in messages]
    assert max(after - before for before, after in pairwise([0.0, *speeds])) == pytest.approx(1.0 / 50.0)
    assert all(message.angular.z == pytest.approx(message.linear.x * 0.5) for message in messages)

    graph.until(lambda: messages[-1].linear.x == 0.0)
    speeds = [message.linear.x for message in messages]
    assert max(before - after for before, after in pairwise(speeds)) == pytest.approx(2.0 / 50.0)


def test_with_feedback_commands_go_on_from_the_robots_velocity(graph: Any) -> None:
    """The robot rolls at 0.4 m/s when the first command comes."""
    graph.start("nodelet/nodelet", _LOAD, name="smoother", frequency=50.0, robot_feedback=1, **_LIMITS)
    messages = graph.listen("/smoother/smooth_cmd_vel", _TWIST)
    raw = graph.advertise("/smoother/raw_cmd_vel", _TWIST)
    odometry = graph.advertise("/smoother/odometry", "nav_msgs/Odometry")
    graph.until(lambda: graph.connected("/smoother/smooth_cmd_vel"))

    def is_near() -> bool:
        odometry.publish({"twist": {"twist": {"linear": {"x": 0.4}}}})
        return any(message.linear.x > 0.4 for message in messages)

    _command(graph, raw, 0.5, 0.0, is_near)
    assert 0.4 < next(message.linear.x for message in messages if message.linear.x > 0.3) < 0.43


def test_limits_are_required(graph: Any, capsys: pytest.CaptureFixture[str]) -> None:
    assert graph.start("nodelet/nodelet", _LOAD, name="smoother").result(PATIENCE_S) == 1
    assert "speed_lim_v is not set" in capsys.readouterr().err
