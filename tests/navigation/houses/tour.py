"""A robot in a building: mapped on a way through it, localized on that map from a wrong guess, sent to goals."""

import json
import math
import os
import subprocess
import sys
from pathlib import Path
from typing import Any, NamedTuple

import yaml
from tests.navigation.houses.buildings import BUILDINGS
from tests.navigation.houses.robots import LIDAR, ROBOTS, Robot

_PLUGINS = Path(__file__).parent / "plugins"
_WORLD = (
    """<sdf version="1.6"><world name="tour"><include><uri>model://ground_plane</uri></include>{}{}</world></sdf>"""
)
_LAUNCH = """<launch><param name="use_sim_time" value="true"/>
<node pkg="gazebo_ros" type="gzserver" name="gazebo" args="{world}"/>
<node pkg="tf2_ros" type="static_transform_publisher" name="scan" args="0 0 0.22 0 0 0 base_footprint base_scan"/>
{nodes}</launch>"""
_MAPPING = """<node pkg="gmapping" type="slam_gmapping" name="slam_gmapping" output="screen">
<rosparam command="load" file="{}"/></node>"""
_NAVIGATION = """<node pkg="map_server" type="map_server" name="map_server" args="{map}"/>
<node pkg="amcl" type="amcl" name="amcl" output="screen"><rosparam command="load" file="{amcl}"/></node>
<node pkg="move_base" type="move_base" name="move_base" output="screen">
<rosparam command="load" file="{move_base}"/></node>"""
_TIMEOUT_S = 900.0
_GMAPPING = {"base_frame": "base_footprint", "linearUpdate": 0.25, "angularUpdate": 0.2, "map_update_interval": 3.0}
_GMAPPING |= {"particles": 20, "delta": 0.05, "xmin": -2.0, "ymin": -2.0, "xmax": 2.0, "ymax": 2.0}


class Tour(NamedTuple):
    """A building, and a robot with its nodes."""

    building: str
    robot: str

    def map(self, folder: Path) -> dict[str, Any]:
        """Lead the robot through the building; write map.yaml into the folder, and return what the guide wrote."""
        building, robot = BUILDINGS[self.building], ROBOTS[self.robot]
        job = {"way": building.way, "speed": 0.5, "turning_m": robot.turning_m, "map": str(folder / "map.yaml")}
        parameters = {**_GMAPPING, "maxUrange": LIDAR.range_m - 0.1, "maxRange": LIDAR.range_m}
        nodes = _MAPPING.format(_write(folder / "slam.yaml", parameters))
        return self._launch(folder, "map", {**job, "limit_s": 700.0}, nodes)

    def drive(self, folder: Path, world_from_map: list[float]) -> dict[str, Any]:
        """Send the robot to the building's goals on the folder's map; return what the guide wrote."""
        building, robot = BUILDINGS[self.building], ROBOTS[self.robot]
        amcl = {"odom_model_type": robot.odometry, "base_frame_id": "base_footprint", "laser_max_beams": 60}
        nodes = _NAVIGATION.format(
            map=folder / "map.yaml",
            amcl=_write(folder / "amcl.yaml", {**amcl, "laser_max_range": LIDAR.range_m}),
            move_base=_write(folder / "move_base.yaml", _move_base(robot)),
        )
        return self._launch(
            folder, "drive", {"goals": building.goals, "world_from_map": world_from_map, "limit_s": 300.0}, nodes
        )

    @property
    def start(self) -> tuple[float, float, float]:
        """Where the robot is mapped from, and starts: x, y [m], yaw [rad] in the world."""
        (x, y), (next_x, next_y) = BUILDINGS[self.building].way[:2]
        return x, y, math.atan2(next_y - y, next_x - x)

    def _launch(self, folder: Path, name: str, job: dict[str, Any], nodes: str) -> dict[str, Any]:
        building, robot = BUILDINGS[self.building], ROBOTS[self.robot]
        job_file, out, world, launch = (folder / f"{name}.{kind}" for kind in ("job", "json", "world", "launch"))
        job_file.write_text(json.dumps({"out": str(out), **job}))
        plugin = f'<plugin name="guide" filename="libguide.so"><job>{job_file}</job></plugin>'
        world.write_text(_WORLD.format(building.sdf, robot.sdf(self.start, plugin)))
        launch.write_text(_LAUNCH.format(world=world, nodes=nodes))
        command = [sys.executable, "-m", "trundle", "launch", str(launch), "--headless", "--speed", "max"]
        variables = {"TRUNDLE_PLUGIN_PATH": str(_PLUGINS), "ROS_HOME": str(folder / "ros")}
        done = subprocess.run(
            [*command, "--port", "0", "--duration", str(job["limit_s"] + 5.0)],
            env={**os.environ, **variables},
            capture_output=True,
            text=True,
            check=False,
            timeout=_TIMEOUT_S,
        )
        (folder / f"{name}.log").write_text(done.stdout + done.stderr)
        assert out.exists(), done.stdout[-4000:] + done.stderr[-4000:]
        return json.loads(out.read_text())


def _write(file: Path, parameters: dict[str, Any]) -> Path:
    file.write_text(yaml.safe_dump(parameters))
    return file


def _move_base(robot: Robot) -> dict[str, Any]:
    costmap = {
        "robot_base_frame": "base_footprint",
        "footprint": [list(corner) for corner in robot.footprint],
        "update_frequency": 5.0,
        "transform_tolerance": 0.5,
        "obstacle_layer": {
            "observation_sources": "scan",
            "scan": {"data_type": "LaserScan", "topic": "/scan", "marking": True, "clearing": True},
        },
        "inflation_layer": {"inflation_radius": 0.6, "cost_scaling_factor": 5.0},
    }
    layers = [("obstacle_layer", "ObstacleLayer"), ("inflation_layer", "InflationLayer")]
    local, whole = (
        [{"name": name, "type": f"costmap_2d::{kind}"} for name, kind in chosen]
        for chosen in (layers, [("static_layer", "StaticLayer"), *layers])
    )
    rolling = {"rolling_window": True, "width": 4.0, "height": 4.0, "resolution": 0.05}
    return {
        "base_local_planner": "dwa_local_planner/DWAPlannerROS",
        "controller_frequency": 10.0,
        "planner_frequency": 1.0,
        "global_costmap": {**costmap, "global_frame": "map", "plugins": whole},
        "local_costmap": {**costmap, "global_frame": "odom", "plugins": local, **rolling},
        "DWAPlannerROS": robot.planner,
    }
