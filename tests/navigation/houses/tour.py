"""A robot in a building: mapped on a way through it, localized on that map from a wrong guess, sent to goals."""

import json
import math
import os
import subprocess
import sys
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
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
_SCANS = """<node pkg="pointcloud_to_laserscan" type="pointcloud_to_laserscan_node" name="scans">
<remap from="cloud_in" to="/velodyne_points"/><rosparam>{target_frame: base_scan, min_height: -0.1, max_height: 0.5,
range_min: 0.15, range_max: 9.9, angle_increment: 0.00873}</rosparam></node>"""
_EBAND = {"xy_goal_tolerance": 0.15, "yaw_goal_tolerance": 0.1, "max_vel_lin": 0.5, "max_vel_th": 1.2}
_TIMEOUT_S = 900.0
_GMAPPING = {"base_frame": "base_footprint", "linearUpdate": 0.25, "angularUpdate": 0.2, "map_update_interval": 3.0}
_GMAPPING |= {"particles": 20, "delta": 0.05, "xmin": -2.0, "ymin": -2.0, "xmax": 2.0, "ymax": 2.0}


class Tour(NamedTuple):
    """A building, and a robot with its nodes."""

    building: str
    robot: str
    planner: str = "dwa_local_planner/DWAPlannerROS"
    has_rings: bool = False
    """Whether its lidar has 16 rings; else it is planar."""

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
            move_base=_write(folder / "move_base.yaml", _move_base(robot, self)),
        ) + (_SCANS if self.has_rings else "")
        return self._launch(
            folder, "drive", {"goals": building.goals, "world_from_map": world_from_map, "limit_s": 300.0}, nodes
        )

    def draw_map(self, folder: Path) -> list[float]:
        """Write map.yaml as the building is, instead of mapping it; return world_from_map."""
        building, size = BUILDINGS[self.building], 0.05
        x0, x1, y0, y1 = building.inside
        points = np.stack(np.meshgrid(np.arange(x0, x1, size), np.arange(y0, y1, size)), axis=-1) + 0.5 * size
        width, height = len(points[0]), len(points)
        distances = building.distances(points.reshape(-1, 2)).reshape(height, width)
        pixels = np.where(distances < 0.5 * size, 0, 254).astype(np.uint8)
        (folder / "map.pgm").write_bytes(f"P5\n{width} {height}\n255\n".encode() + np.flipud(pixels).tobytes())
        values = {"image": "map.pgm", "resolution": size, "origin": [x0, y0, 0.0], "negate": 0}
        _write(folder / "map.yaml", {**values, "occupied_thresh": 0.65, "free_thresh": 0.196})
        return [0.0, 0.0, 0.0]

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
        world.write_text(_WORLD.format(building.sdf, robot.sdf(self.start, plugin, has_rings=self.has_rings)))
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


def _move_base(robot: Robot, tour: Tour) -> dict[str, Any]:
    scan: dict[str, Any] = {"data_type": "LaserScan", "topic": "/scan", "marking": True, "clearing": True}
    if tour.has_rings:
        scan |= {"data_type": "PointCloud2", "topic": "/velodyne_points", "min_obstacle_height": 0.1}
    costmap = {
        "robot_base_frame": "base_footprint",
        "footprint": [list(corner) for corner in robot.footprint],
        "update_frequency": 5.0,
        "transform_tolerance": 0.5,
        "obstacle_layer": {"observation_sources": "scan", "scan": scan},
        "inflation_layer": {"inflation_radius": 0.6, "cost_scaling_factor": 5.0},
    }
    layers = [("obstacle_layer", "ObstacleLayer"), ("inflation_layer", "InflationLayer")]
    local, whole = (
        [{"name": name, "type": f"costmap_2d::{kind}"} for name, kind in chosen]
        for chosen in (layers, [("static_layer", "StaticLayer"), *layers])
    )
    rolling = {"rolling_window": True, "width": 4.0, "height": 4.0, "resolution": 0.05}
    return {
        "base_local_planner": tour.planner,
        "controller_frequency": 10.0,
        "planner_frequency": 1.0,
        "global_costmap": {**costmap, "global_frame": "map", "plugins": whole},
        "local_costmap": {**costmap, "global_frame": "odom", "plugins": local, **rolling},
        "DWAPlannerROS": robot.planner,
        "EBandPlannerROS": _EBAND,
    }
