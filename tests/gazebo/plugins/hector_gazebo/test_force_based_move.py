"""Force-based moves against the first-order lag of a mass under a proportional gain."""

import math
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from tests.gazebo.plugins.plugin_world import BODY, FakeNode, load

from trundle.sim.simulation import Simulation

MASS, GAIN, YAW_GAIN, INERTIA = 2.0, 10.0, 0.5, 0.1
GAINS = (
    f"<x_velocity_p_gain>{GAIN}</x_velocity_p_gain><y_velocity_p_gain>{GAIN}</y_velocity_p_gain>"
    f"<yaw_velocity_p_gain>{YAW_GAIN}</yaw_velocity_p_gain>"
)


def robot(folder: Path, library: str, parameters: str = "", pose: str = "0 0 1 0 0 0") -> tuple[Simulation, FakeNode]:
    node: Any = FakeNode()
    node.clock = SimpleNamespace(now_ns=lambda: sim.time_ns)
    body = f'<pose>{pose}</pose><link name="base_footprint">{BODY.format(MASS)}</link>'
    sim = load(folder, f'{body}<plugin name="p" filename="{library}">{GAINS}{parameters}</plugin>', node=node)
    return sim, node


def test_speeds_converge_with_the_time_constant_of_gain_and_mass(tmp_path: Path) -> None:
    """In the model's axes; its x is along the world's y."""
    sim, node = robot(tmp_path, "libgazebo_ros_force_based_move.so", pose=f"0 0 1 0 0 {math.pi / 2}")
    node.receive("/cmd_vel", linear={"x": 0.5, "y": -0.3})
    sim.run(0.2)

    ratio = 1.0 - math.exp(-GAIN / MASS * 0.2)
    vx, vy, _ = sim["m"].twist.linear
    assert (vx, vy) == (pytest.approx(0.3 * ratio, rel=5e-3), pytest.approx(0.5 * ratio, rel=5e-3))
    node.receive("/cmd_vel", angular={"z": 0.4})
    sim.run(0.2)
    assert sim["m"].twist.angular[2] == pytest.approx(0.4 * (1.0 - math.exp(-YAW_GAIN / INERTIA * 0.2)), rel=5e-3)


def test_odometry_starts_at_zero_with_a_large_yaw_variance_in_turns(tmp_path: Path) -> None:
    sim, node = robot(tmp_path, "libgazebo_ros_force_based_move.so", "<odometryRate>100</odometryRate>", "3 2 1 0 0 1")
    node.receive("/cmd_vel", linear={"x": 0.5, "y": 0.2}, angular={"z": 0.3})
    sim.run(3.0)

    message = node.published["/odom"][-1]
    x, y, _ = sim["m"].pose.position
    east, north = x - 3.0, y - 2.0
    along, across = math.cos(1) * east + math.sin(1) * north, math.cos(1) * north - math.sin(1) * east
    assert (message.pose.pose.position.x, message.pose.pose.position.y) == (
        pytest.approx(along, abs=0.01),
        pytest.approx(across, abs=0.01),
    )
    assert (message.header.frame_id, message.child_frame_id) == ("odom", "base_footprint")
    lag = MASS * 0.3 * message.twist.twist.linear.x / GAIN  # the centripetal force needs a velocity error
    assert message.twist.twist.linear.y == pytest.approx(0.2 - lag, abs=1e-3)
    assert message.twist.twist.angular.z == pytest.approx(0.3, abs=1e-4)
    assert (message.pose.covariance[14], message.pose.covariance[35], message.twist.covariance[14]) == (
        1e12,
        100.0,
        1e-3,
    )
    assert "/tf" in node.published


def test_ridgeback_stops_when_commands_end(tmp_path: Path) -> None:
    sim, node = robot(tmp_path, "libridgeback_ros_force_based_move.so", "<publishOdometryTf>false</publishOdometryTf>")
    node.receive("/cmd_vel", linear={"x": 0.5, "y": 0.5})
    sim.run(0.2)
    before = sim["m"].twist.linear[0]
    sim.run(1.0)

    rest = before + (0.5 - before) * (1.0 - math.exp(-GAIN / MASS * 0.05))
    assert sim["m"].twist.linear[0] == pytest.approx(rest * math.exp(-GAIN / MASS * 0.95), rel=0.02)
    assert node.published["/odom"][0].twist.twist.linear.y == 0.0
    assert node.published["/odom"][-1].pose.covariance[35] == 0.01
    assert "/tf" not in node.published


def test_robotnik_holds_its_pose_when_commands_end(tmp_path: Path) -> None:
    sim, node = robot(tmp_path, "librobotnik_force_based_move.so", "<commandWatchdog>0.5</commandWatchdog>")
    node.receive("/cmd_vel", linear={"x": 0.5})
    sim.run(0.6)
    pose, count = sim["m"].pose, len(node.published["/odom"])
    sim.run(1.0)

    assert sim["m"].pose.position == pytest.approx(pose.position, abs=1e-6)
    assert pose.position[0] > 0.1
    assert len(node.published["/odom"]) == count
