"""amcl and move_base on ten goals in a house of five rooms, against the figures of the real nodes in that house.

Five tours begin at different goals, with DWA and with trajectory rollout, with the wheels' odometry and with one made
worse. The real nodes were not run: the house's README has their figures. CPU time is that of the whole process, less
that of the simulation alone.
"""

import json
import math
import os
import runpy
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any

from bench.commands import SHARED
from bench.table import Row

HOUSE = SHARED / "peers/navigation/house_nav"
GOALS = (
    (-3.4, -3.3, 1.57),
    (1.0, -1.2, 0.0),
    (3.6, -3.2, -1.57),
    (3.4, 1.5, 1.57),
    (2.4, 3.3, 3.14),
    (0.9, 1.0, -1.57),
    (-0.4, 3.3, 1.57),
    (-2.55, 3.3, 1.57),
    (-4.3, 1.0, 3.14),
    (-2.0, -0.8, 0.0),
)
"""x, y [m] and yaw [rad] of each goal, as the house's own script sends them."""
_STARTS = (9, 1, 3, 5, 7)
_SUCCEEDED = 3
_RADIUS_M = 0.17
_PLUGINS = Path(__file__).parent / "house_tour"
_LIMIT_S = 400
"""Longest time of a tour [s of the simulation]."""
_BASELINE_S = 60
_REAL = {"dwa": (211.7, 0.26), "trajectory": (191.2, 0.22)}
"""Time of ten goals [s] and share of a core of amcl with move_base."""
_ODOMETRY = {False: "wheels", True: "made worse"}
_LAUNCH = """
<launch>
  <include file="$(find house_nav)/launch/sim.launch">{start}</include>
  <param name="robot_description" textfile="{urdf}"/>
  {nodes}
</launch>
"""
_NODES = """
  <include file="$(find house_nav)/launch/amcl.launch">{start}</include>
  <include file="$(find house_nav)/launch/move_base.launch"><arg name="planner" value="{planner}"/></include>
"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Tour:
    """Results of one run's goals."""

    goals: list[dict[str, Any]]
    """State, seconds, length and shortest [m], clearance [m], error_m and error_deg of each."""
    cpu_s: float
    """Time of the whole process, with the simulation."""

    @property
    def reached(self) -> int:
        """Number of goals that move_base reached."""
        return sum(goal["state"] == _SUCCEEDED for goal in self.goals)

    @property
    def seconds(self) -> float:
        """Time of all goals."""
        return sum(goal["seconds"] for goal in self.goals)

    @property
    def ratio(self) -> float:
        """Length of the way by that of the shortest."""
        return sum(goal["length"] for goal in self.goals) / sum(goal["shortest"] for goal in self.goals)

    @property
    def clearance_m(self) -> float:
        """Least distance of the robot's disc to walls and furniture; negative: collision."""
        return min(goal["clearance"] for goal in self.goals)


def drive(first: int, *, planner: str = "dwa", is_worse: bool = False, count: int = len(GOALS)) -> Tour:
    """Drive to goals, beginning at one of them.

    Args:
        first: number of the goal at which the robot begins; it drives to those after it.
        planner: 'dwa' or 'trajectory'.
        is_worse: True: worse odometry.
        count: number of goals.
    """
    goals = [GOALS[(first + 1 + index) % len(GOALS)] for index in range(count)]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        out = folder / "goals.json"
        tags = f"<goals>{json.dumps(goals)}</goals><out>{out}</out>"
        tags = f'<plugin name="goals" filename="libsend_goals.so">{tags}</plugin>'
        nodes = _NODES.format(start=_start_arguments(first), planner=planner)
        cpu_s = launch(folder, first, housebot(tags, is_worse=is_worse), nodes, _LIMIT_S)
        return Tour(goals=_judged(json.loads(out.read_text()), folder), cpu_s=cpu_s)


def _start_arguments(first: int) -> str:
    values = zip(("x", "y", "yaw"), GOALS[first], strict=True)
    return "".join(f'<arg name="{name}" value="{value}"/>' for name, value in values)


def housebot(tags: str, *, is_worse: bool) -> str:
    """Return the robot's URDF with more plugins, and with the odometry made worse."""
    description = (HOUSE / "urdf/housebot.urdf").read_text()
    if is_worse:
        description = description.replace("<odometryTopic>odom<", "<odometryTopic>wheel_odom<")
        description = description.replace("<publishOdomTF>true<", "<publishOdomTF>false<")
        tags += '<plugin name="worse" filename="libworse_odometry.so"/>'
    return description.replace("</robot>", f"<gazebo>{tags}</gazebo></robot>")


def launch(folder: Path, first: int, description: str, nodes: str, limit_s: int) -> float:
    """Launch the house with a robot at a goal, flat out; return the CPU time [s].

    Args:
        folder: for the files of the run.
        first: number of the goal at which the robot begins.
        description: URDF of the robot.
        nodes: elements of the launch file.
        limit_s: longest time [s of the simulation].
    """
    urdf, file = folder / "housebot.urdf", folder / "tour.launch"
    urdf.write_text(description)
    file.write_text(_LAUNCH.format(start=_start_arguments(first), urdf=urdf, nodes=nodes))
    command = [sys.executable, "-m", "trundle", "launch", "--port", "0", str(file), "--headless", "--speed", "max"]
    variables = {"ROS_PACKAGE_PATH": str(HOUSE), "TRUNDLE_PLUGIN_PATH": str(_PLUGINS), "ROS_HOME": str(folder)}
    before = os.times()
    quiet: dict[str, Any] = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    subprocess.run([*command, "--duration", str(limit_s)], env={**os.environ, **variables}, check=False, **quiet)
    after = os.times()
    return after.children_user + after.children_system - before.children_user - before.children_system


def _judged(rows: list[dict[str, Any]], folder: Path) -> list[dict[str, Any]]:
    """Measure ways, and shortest ways by the house's own script."""
    ended = [row for row in rows if "state" in row]
    boxes = _boxes()
    for row in ended:
        track, (x, y, yaw) = row["track"], row["goal"]
        row["length"] = sum(math.dist(a[:2], b[:2]) for a, b in pairwise(track))
        row["clearance"] = min(_clearance_m(boxes, *place[:2]) for place in track)
        row["start"] = track[0][:2]
        row["error_m"] = math.dist(track[-1][:2], (x, y))
        row["error_deg"] = abs(math.degrees(math.remainder(track[-1][2] - yaw, math.tau)))
    file = folder / "judged.json"
    file.write_text(json.dumps({"goals": ended}))
    subprocess.run([sys.executable, HOUSE / "scripts/shortest.py", file], check=True, stdout=subprocess.DEVNULL)
    return json.loads(file.read_text())["goals"]


def _boxes() -> list[tuple[float, ...]]:
    """Return x0, x1, y0, y1 [m] of walls and furniture."""
    house = runpy.run_path(str(HOUSE / "scripts/make_house.py"))
    return [*house["WALLS"].values(), *(box[:4] for box in house["FURNITURE"].values())]


def _clearance_m(boxes: Sequence[Sequence[float]], x: float, y: float) -> float:
    return min(math.hypot(max(b[0] - x, 0, x - b[1]), max(b[2] - y, 0, y - b[3])) for b in boxes) - _RADIUS_M


def _simulation_share() -> float:
    """Return the CPU time of a second of the simulation alone, with the start of the process."""
    tag = '<plugin name="circles" filename="libdrive_in_circles.so"/>'
    with tempfile.TemporaryDirectory() as name:
        return launch(Path(name), 9, housebot(tag, is_worse=False), "", _BASELINE_S) / _BASELINE_S


def run() -> list[Row]:
    """Drive every tour."""
    if not HOUSE.is_dir():
        return []
    simulation = _simulation_share()
    rows: list[Row] = []
    for planner, (real_s, real_share) in _REAL.items():
        for is_worse, odometry in _ODOMETRY.items():
            tours = [drive(first, planner=planner, is_worse=is_worse) for first in _STARTS]
            reached, count = sum(tour.reached for tour in tours), len(_STARTS) * len(GOALS)
            name, peer = f"{planner}, {odometry}", "the real nodes, not in this run"
            slowest = max(tour.seconds for tour in tours)
            share = max(tour.cpu_s / tour.seconds for tour in tours) - simulation
            rows += [
                Row(f"{name}: goals reached of {count}", reached, "", "", None),
                Row(f"{name}: ten goals, slowest start", slowest, "s", peer, slowest / real_s),
                Row(f"{name}: way by the shortest", max(tour.ratio for tour in tours), "", "", None),
                Row(f"{name}: least clearance", min(tour.clearance_m for tour in tours), "m", "", None),
                Row(f"{name}: amcl and move_base", share, "cores", peer, share / real_share),
            ]
    return rows
