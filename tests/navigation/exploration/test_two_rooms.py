"""A robot explores two rooms with gmapping and move_base until its map is complete."""

import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from trundle.ros import Messages, open_bag

pytestmark = pytest.mark.slow
_PACKAGE = Path(__file__).parents[1] / "move_base/two_rooms"
_GOAL_PLUGIN = '<plugin name="goal" filename="libsend_goal.so"/>'
_EXPLORE_LITE = """
  <node pkg="explore_lite" type="explore" name="explore" output="screen">
    <param name="robot_base_frame" value="base_footprint"/>
    <param name="costmap_topic" value="map"/>
    <param name="costmap_updates_topic" value="map_updates"/>
    <param name="planner_frequency" value="0.5"/>
    <param name="potential_scale" value="3.0"/>
    <param name="min_frontier_size" value="0.5"/>
  </node>
"""
_RRT_EXPLORATION = """
  <node pkg="rrt_exploration" type="global_rrt_detector" name="global_detector">
    <param name="eta" value="3.0"/>
    <param name="map_topic" value="/map"/>
  </node>
  <node pkg="rrt_exploration" type="local_rrt_detector" name="local_detector">
    <param name="eta" value="1.0"/>
    <param name="map_topic" value="/map"/>
    <param name="robot_frame" value="/base_footprint"/>
  </node>
  <node pkg="rrt_exploration" type="filter.py" name="filter">
    <param name="global_costmap_topic" value="/move_base/global_costmap/costmap"/>
    <param name="robot_frame" value="base_footprint"/>
  </node>
  <node pkg="rrt_exploration" type="assigner.py" name="assigner" output="screen">
    <param name="robot_frame" value="base_footprint"/>
  </node>
"""
_CLICKS = ((-6.0, -3.5), (2.0, -3.5), (2.0, 2.0), (-6.0, 2.0), (0.0, 0.0))
"""Corners of a region around the rooms, and the tree's root, in the map [m]."""
_CLICK_PLUGIN = f"""
from trundle.gazebo.plugins import Plugin

class Click(Plugin):
    period_ns = 1_000_000_000

    @classmethod
    def load(cls, sim, model, node, tag):
        plugin = cls()
        plugin.points = node.advertise("/clicked_point", "geometry_msgs/PointStamped", queue_size=None)
        return plugin

    def after_step(self, snapshot):
        if snapshot.time_ns // self.period_ns == 2:
            for x, y in {_CLICKS}:
                self.points.publish({{"header": {{"frame_id": "map"}}, "point": {{"x": x, "y": y}}}})
"""
_LAUNCH = """
<launch>
  <param name="use_sim_time" value="true"/>
  <node pkg="gazebo_ros" type="gzserver" name="gazebo" args="$(find two_rooms)/two_rooms.world"/>
  <node pkg="tf2_ros" type="static_transform_publisher" name="scan" args="-0.03 0 0.17 0 0 0 base_footprint base_scan"/>
  <node pkg="gmapping" type="slam_gmapping" name="slam_gmapping">
    <rosparam>
      {{base_frame: base_footprint, xmin: -1.0, ymin: -1.0, xmax: 1.0, ymax: 1.0, map_update_interval: 1.0,
        linearUpdate: 0.2, angularUpdate: 0.2, temporalUpdate: 1.0, particles: 10}}
    </rosparam>
  </node>
  <node pkg="move_base" type="move_base" name="move_base">
    <rosparam command="load" file="$(find two_rooms)/move_base.yaml"/>
    <param name="base_local_planner" value="dwa_local_planner/DWAPlannerROS"/>
  </node>
  {explorer}
</launch>
"""


def explore(
    folder: Path, *, name: str, duration: int, explorer: str = _EXPLORE_LITE, plugin: str = ""
) -> tuple[Path, str]:
    """Launch the package flat out for some seconds of simulated time; returns the bag and what is printed."""
    package = folder / "two_rooms"
    if not package.exists():
        shutil.copytree(_PACKAGE, package)
        world = package / "two_rooms.world"
        text = world.read_text()
        assert _GOAL_PLUGIN in text
        (package / "click.py").write_text(_CLICK_PLUGIN)
        world.write_text(text.replace(_GOAL_PLUGIN, plugin))
    launch, bag = package / f"{name}.launch", folder / f"{name}.bag"
    launch.write_text(_LAUNCH.format(explorer=explorer))
    command = [sys.executable, "-m", "trundle", "launch", str(launch), "--headless", "--speed", "max", "--port", "0"]
    environment = {**os.environ, "ROS_PACKAGE_PATH": str(folder), "ROS_HOME": str(folder / "ros")}
    options = ["--duration", str(duration), "--record", str(bag)]
    done = subprocess.run(
        [*command, *options], env=environment, capture_output=True, text=True, check=False, timeout=3600
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return bag, done.stdout + done.stderr


def read(bag: Path, topic: str) -> list[Any]:
    messages = Messages()
    with open_bag(bag) as reader:
        return [
            messages.deserialize(item.data, item.connection.type)
            for item in reader.messages(lambda connection: connection.topic == topic)
        ]


def known_ratio(message: Any) -> float:
    """Return the ratio of the rooms, 6 m × 3 m less walls and the box, that the map knows to be free."""
    cells: NDArray[np.int8] = np.array(message.data, dtype=np.int8)
    room_m2 = 6.0 * 3.0 - 0.1 * (3.0 - 0.9) - 0.3 * 0.3
    return np.count_nonzero(cells == 0) * message.info.resolution**2 / room_m2


def test_two_rooms_are_mapped_by_exploring(tmp_path: Path) -> None:
    """The map begins with less than the room that the robot is in; the door is 0.9 m wide."""
    bag, printed = explore(tmp_path, name="explore", duration=40)

    maps, bumps = read(bag, "/map"), read(bag, "/bumper")
    assert known_ratio(maps[0]) < 0.75
    assert known_ratio(maps[-1]) > 0.95
    assert "Exploration stopped." in printed
    assert not any(message.states for message in bumps)


def test_two_rooms_are_mapped_by_trees_that_grow_at_random(tmp_path: Path) -> None:
    """rrt_exploration begins with five clicked points; how long it takes is up to the trees: here 36 s."""
    bag, printed = explore(
        tmp_path,
        name="rrt",
        duration=60,
        explorer=_RRT_EXPLORATION,
        plugin='<plugin name="click" filename="libclick.so"/>',
    )

    assert known_ratio(read(bag, "/map")[-1]) > 0.95
    assert "assigned to" in printed
    assert not any(message.states for message in read(bag, "/bumper"))


def test_an_exploration_is_the_same_in_every_run(tmp_path: Path) -> None:
    bags = [explore(tmp_path, name=f"run{number}", duration=8)[0] for number in (1, 2)]

    assert read(bags[0], "/move_base/goal")
    assert bags[0].read_bytes() == bags[1].read_bytes()
