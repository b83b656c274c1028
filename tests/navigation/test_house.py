"""amcl, gmapping and move_base in a house of five rooms with a driving robot, as launch files start them."""

import math
import os
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
from bench.navigation import drive as drive_to_goals
from numpy.typing import NDArray

from trundle.gazebo.nodes.map_server.occupancy_grid import read_map
from trundle.ros import Message, Messages, open_bag, to_nsec

pytestmark = pytest.mark.slow
HECTOR = """
  <node pkg="hector_mapping" type="hector_mapping" name="hector_mapping">
    <param name="base_frame" value="base_footprint"/>
    <param name="pub_map_odom_transform" value="false"/>
    <param name="map_resolution" value="0.05"/>
    <param name="map_size" value="512"/>
  </node>
"""
KARTO = """
  <node pkg="slam_karto" type="slam_karto" name="slam_karto">
    <param name="base_frame" value="base_footprint"/>
  </node>
"""
OWN = {"hector": HECTOR, "karto": KARTO}
"""Nodes that the house has no launch file for."""
LAUNCH = """
<launch>
  <include file="$(find house_nav)/launch/sim.launch"/>
  <param name="robot_description" textfile="{robot}"/>
  {nodes}
</launch>
"""
CIRCLES = """
from trundle.gazebo.plugins import Plugin

class Circles(Plugin):
    period_ns = 100_000_000

    @classmethod
    def load(cls, sim, model, node, tag):
        plugin = cls()
        plugin.commands = node.advertise("/cmd_vel", "geometry_msgs/Twist", queue_size=1)
        return plugin

    def after_step(self, snapshot):
        self.commands.publish({"linear": {"x": 0.2}, "angular": {"z": -0.4}})
"""
"""Plugin that commands a velocity; `rostopic pub` would begin after some of the simulated time, or all of it."""


def drive(house: Path, folder: Path, nodes: str, *, name: str, arguments: str = "") -> Path:
    """Drive in circles for 30 s, flat out; returns the bag."""
    file, robot, bag = folder / f"{name}.launch", folder / "robot.urdf", folder / f"{name}.bag"
    (folder / "circles.py").write_text(CIRCLES)
    tag = '<gazebo><plugin name="circles" filename="libcircles.so"/></gazebo>'
    robot.write_text((house / "urdf/housebot.urdf").read_text().replace("</robot>", f"{tag}</robot>"))
    included = f'<include file="$(find house_nav)/launch/{nodes}.launch">{arguments}</include>'
    file.write_text(LAUNCH.format(nodes=OWN.get(nodes, included), robot=robot))
    command = [sys.executable, "-m", "trundle", "launch", "--port", "0", str(file), "--headless"]
    options = ["--speed", "max", "--duration", "30", "--record", str(bag)]
    env = {**os.environ, "ROS_PACKAGE_PATH": str(house), "TRUNDLE_PLUGIN_PATH": str(folder)}
    subprocess.run([*command, *options], env=env, check=True, timeout=600, stdout=subprocess.DEVNULL)
    return bag


def read(bag: Path, topic: str) -> list[Message]:
    messages = Messages()
    with open_bag(bag) as opened:
        return [
            messages.deserialize(message.data, message.connection.type)
            for message in opened.messages(lambda connection: connection.topic == topic)
        ]


def planar(messages: Sequence[Message]) -> NDArray[np.float64]:
    """Stamp [s], x, y [m], yaw [rad] of each message."""
    rows: list[list[float]] = []
    for message in messages:
        pose = message.pose.pose
        yaw = 2.0 * math.atan2(pose.orientation.z, pose.orientation.w)
        rows.append([to_nsec(message.header.stamp) / 1e9, pose.position.x, pose.position.y, yaw])
    return np.array(rows)


@pytest.fixture
def house(shared: Path) -> Path:
    folder = shared / "peers/navigation/house_nav"
    if not folder.is_dir():
        pytest.skip(f"the house is not in {folder}")
    return folder


def test_amcl_finds_a_driving_robot_from_a_wrong_guess(house: Path, tmp_path: Path) -> None:
    guess = '<arg name="x" value="-1.7"/><arg name="yaw" value="0.3"/>'  # 0.3 m and 17° beside the robot
    bag = drive(house, tmp_path, "amcl", name="amcl", arguments=guess)

    estimates, truth = planar(read(bag, "/amcl_pose")), planar(read(bag, "/ground_truth"))
    late = estimates[estimates[:, 0] > 20.0]
    errors = [
        np.hypot(x - np.interp(stamp, truth[:, 0], truth[:, 1]), y - np.interp(stamp, truth[:, 0], truth[:, 2]))
        for stamp, x, y, _ in late
    ]
    assert len(late) > 10
    assert np.median(errors) < 0.03


@pytest.mark.parametrize("nodes", ["amcl", "gmapping", "hector", "karto"])
def test_recordings_are_the_same_in_every_run(house: Path, tmp_path: Path, nodes: str) -> None:
    """Random numbers have a seed, and time waits for the nodes."""
    bags = [drive(house, tmp_path, nodes, name=f"{nodes}{number}") for number in (1, 2)]

    assert read(bags[0], "/particlecloud" if nodes == "amcl" else "/map")
    assert bags[0].read_bytes() == bags[1].read_bytes()


@pytest.mark.parametrize("nodes", ["gmapping", "karto"])
def test_the_room_around_a_driving_robot_is_mapped(house: Path, tmp_path: Path, nodes: str) -> None:
    bag = drive(house, tmp_path, nodes, name=nodes)

    last = read(bag, "/map")[-1]
    cells = np.array(last.data, dtype=np.int8).reshape(last.info.height, last.info.width)
    # The map's frame has its origin in the start (-2.0, -0.8); the plan's walls lie in the same cells.
    rows, columns = np.nonzero(cells == 100)
    corner = np.array([last.info.origin.position.x, last.info.origin.position.y])
    found = np.stack([columns, rows], axis=1) * 0.05 + 0.025 + corner + np.array([-2.0, -0.8])
    plan = _occupied(house / "maps/house.yaml")
    near = np.array([np.abs(plan - place).max(axis=1).min() < 0.051 for place in found])
    assert len(found) > 200
    assert near.mean() > 0.97


def test_hector_mapping_follows_the_driving_robot_without_odometry(house: Path, tmp_path: Path) -> None:
    """The map begins at the robot (-2.0, -0.8) with its heading."""
    bag = drive(house, tmp_path, "hector", name="hector")

    found, truth = planar(read(bag, "/poseupdate")), planar(read(bag, "/ground_truth"))
    errors = [
        np.hypot(
            x - 2.0 - np.interp(stamp, truth[:, 0], truth[:, 1]), y - 0.8 - np.interp(stamp, truth[:, 0], truth[:, 2])
        )
        for stamp, x, y, _ in found
    ]
    assert len(errors) > 250
    assert max(errors) < 0.1
    assert np.median(errors) < 0.05
    last = read(bag, "/map")[-1]
    assert 100 in np.array(last.data)


@pytest.mark.usefixtures("house")
@pytest.mark.parametrize("planner", ["dwa", "trajectory"])
def test_amcl_and_move_base_reach_goals_with_an_odometry_that_is_wrong_by_a_few_percent(planner: str) -> None:
    """Through two doors of 0.9 m, past a table."""
    tour = drive_to_goals(9, planner=planner, is_worse=True, count=2)

    assert tour.reached == 2
    assert tour.clearance_m > 0.09
    assert tour.ratio < 1.1
    assert max(goal["error_m"] for goal in tour.goals) < 0.2


def _occupied(file: Path) -> NDArray[np.float64]:
    """Centers of the plan's occupied cells [m]."""
    grid = read_map(file)
    rows, columns = np.nonzero(grid.cells == 100)
    centers = (np.stack([columns, rows], axis=1) + 0.5) * grid.resolution_m + np.array(grid.origin[:2])
    return centers.astype(np.float64)
