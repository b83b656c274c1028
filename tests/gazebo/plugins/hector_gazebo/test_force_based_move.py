"""Force-based moves, against the first-order lag that a gain makes of a mass."""

import math
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from tests.gazebo.plugins.stage import BODY, Wires, load

from trundle.sim.simulation import Simulation

MASS, GAIN, YAW_GAIN, INERTIA = 2.0, 10.0, 0.5, 0.1
GAINS = (
    f"<x_velocity_p_gain>{GAIN}</x_velocity_p_gain><y_velocity_p_gain>{GAIN}</y_velocity_p_gain>"
    f"<yaw_velocity_p_gain>{YAW_GAIN}</yaw_velocity_p_gain>"
)


def robot(folder: Path, library: str, parameters: str = "", pose: str = "0 0 1 0 0 0") -> tuple[Simulation, Wires]:
    wires: Any = Wires()
    wires.clock = SimpleNamespace(now_ns=lambda: sim.time_ns)
    body = f'<pose>{pose}</pose><link name="base_footprint">{BODY.format(MASS)}</link>'
    sim = load(folder, f'{body}<plugin name="p" filename="{library}">{GAINS}{parameters}</plugin>', wires=wires)
    return sim, wires


def test_speeds_close_in_with_the_time_constant_of_gain_and_mass(tmp_path: Path) -> None:
    """Along the model's own axes, of which x points to the world's y here."""
    sim, wires = robot(tmp_path, "libgazebo_ros_force_based_move.so", pose=f"0 0 1 0 0 {math.pi / 2}")
    wires.tell("/cmd_vel", linear={"x": 0.5, "y": -0.3})
    sim.run(0.2)

    share = 1.0 - math.exp(-GAIN / MASS * 0.2)
    vx, vy, _ = sim["m"].twist.linear
    assert (vx, vy) == (pytest.approx(0.3 * share, rel=5e-3), pytest.approx(0.5 * share, rel=5e-3))
    wires.tell("/cmd_vel", angular={"z": 0.4})
    sim.run(0.2)
    assert sim["m"].twist.angular[2] == pytest.approx(0.4 * (1.0 - math.exp(-YAW_GAIN / INERTIA * 0.2)), rel=5e-3)


def test_odometry_adds_up_from_zero_and_is_unsure_of_its_heading_while_it_turns(tmp_path: Path) -> None:
    sim, wires = robot(tmp_path, "libgazebo_ros_force_based_move.so", "<odometryRate>100</odometryRate>", "3 2 1 0 0 1")
    wires.tell("/cmd_vel", linear={"x": 0.5, "y": 0.2}, angular={"z": 0.3})
    sim.run(3.0)

    told = wires.said["/odom"][-1]
    x, y, _ = sim["m"].pose.position
    east, north = x - 3.0, y - 2.0
    along, across = math.cos(1) * east + math.sin(1) * north, math.cos(1) * north - math.sin(1) * east
    assert (told.pose.pose.position.x, told.pose.pose.position.y) == (
        pytest.approx(along, abs=0.01),
        pytest.approx(across, abs=0.01),
    )
    assert (told.header.frame_id, told.child_frame_id) == ("odom", "base_footprint")
    lag = MASS * 0.3 * told.twist.twist.linear.x / GAIN  # the force that bends the path takes an error
    assert told.twist.twist.linear.y == pytest.approx(0.2 - lag, abs=1e-3)
    assert told.twist.twist.angular.z == pytest.approx(0.3, abs=1e-4)
    assert (told.pose.covariance[14], told.pose.covariance[35], told.twist.covariance[14]) == (1e12, 100.0, 1e-3)
    assert "/tf" in wires.said


def test_ridgeback_stops_when_commands_end(tmp_path: Path) -> None:
    sim, wires = robot(tmp_path, "libridgeback_ros_force_based_move.so", "<publishOdometryTf>false</publishOdometryTf>")
    wires.tell("/cmd_vel", linear={"x": 0.5, "y": 0.5})
    sim.run(0.2)
    before = sim["m"].twist.linear[0]
    sim.run(1.0)

    rest = before + (0.5 - before) * (1.0 - math.exp(-GAIN / MASS * 0.05))
    assert sim["m"].twist.linear[0] == pytest.approx(rest * math.exp(-GAIN / MASS * 0.95), rel=0.02)
    assert wires.said["/odom"][0].twist.twist.linear.y == 0.0
    assert wires.said["/odom"][-1].pose.covariance[35] == 0.01
    assert "/tf" not in wires.said


def test_robotnik_holds_its_place_when_commands_end(tmp_path: Path) -> None:
    sim, wires = robot(tmp_path, "librobotnik_force_based_move.so", "<commandWatchdog>0.5</commandWatchdog>")
    wires.tell("/cmd_vel", linear={"x": 0.5})
    sim.run(0.6)
    there, told = sim["m"].pose, len(wires.said["/odom"])
    sim.run(1.0)

    assert sim["m"].pose.position == pytest.approx(there.position, abs=1e-6)
    assert there.position[0] > 0.1
    assert len(wires.said["/odom"]) == told
