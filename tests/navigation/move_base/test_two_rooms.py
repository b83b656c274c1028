"""A robot drives through a door, around a box that is not on its map."""

import math
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from tests.navigation.move_base.two_rooms_package import WALLS, make_two_rooms

from trundle.ros import Messages, open_bag

_GOAL = (2.4, 0.8)
_BOX = (1.25, 1.55, 0.55, 0.85)
_RADIUS_M = 0.17
_TOPICS = frozenset({"/base_pose_ground_truth", "/bumper", "/move_base/result", "/move_base/status"})


def _drive(folder: Path, *arguments: str, name: str = "run", duration: int = 40) -> dict[str, list[Any]]:
    """Launch the package for some seconds of simulated time; return its recorded messages by topic."""
    make_two_rooms(folder)
    bag = folder / f"{name}.bag"
    words = ["launch", "two_rooms", "two_rooms.launch", *arguments, "--headless", "--speed", "max"]
    command = [sys.executable, "-m", "trundle", *words, "--duration", str(duration), "--record", str(bag)]
    environment = {**os.environ, "ROS_PACKAGE_PATH": str(folder), "ROS_HOME": str(folder / "ros")}
    done = subprocess.run(
        [*command, "--port", "0"], env=environment, capture_output=True, text=True, check=False, timeout=300
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return _recorded(bag)


def _recorded(bag: Path) -> dict[str, list[Any]]:
    library = Messages()
    recorded: dict[str, list[Any]] = {}
    with open_bag(bag) as reader:
        for item in reader.messages():
            if item.connection.topic in _TOPICS:
                recorded.setdefault(item.connection.topic, []).append(
                    library.deserialize(item.data, item.connection.type)
                )
    return recorded


def _clearance_m(x: float, y: float) -> float:
    """Return the distance between the robot's hull and the nearest wall or the box."""
    return min(
        math.hypot(max(x0 - x, 0.0, x - x1), max(y0 - y, 0.0, y - y1)) - _RADIUS_M for x0, x1, y0, y1 in (*WALLS, _BOX)
    )


@pytest.mark.slow
@pytest.mark.parametrize(
    "planner",
    [
        "dwa_local_planner/DWAPlannerROS",
        "base_local_planner/TrajectoryPlannerROS",
        "teb_local_planner/TebLocalPlannerROS",
        "eband_local_planner/EBandPlannerROS",
    ],
)
def test_a_goal_behind_a_door_is_reached_without_contact(planner: str, tmp_path: Path) -> None:
    _check(_drive(tmp_path, f"planner:={planner}"))


@pytest.mark.slow
def test_move_base_flex_drives_behind_the_legacy_relay(tmp_path: Path) -> None:
    _check(_drive(tmp_path, "flex:=true"))


def _check(recorded: dict[str, list[Any]]) -> None:
    """Check that the goal was reached without contact."""
    statuses = [goal.status for message in recorded["/move_base/status"] for goal in message.status_list]
    track = [(m.pose.pose.position.x, m.pose.pose.position.y) for m in recorded["/base_pose_ground_truth"]]
    assert statuses[-1] == 3
    assert recorded["/move_base/result"][0].status.text == "Goal reached."
    assert math.dist(track[-1], _GOAL) < 0.15
    assert min(_clearance_m(x, y) for x, y in track) > 0.05
    assert not any(message.states for message in recorded["/bumper"])


@pytest.mark.slow
def test_the_same_run_gives_the_same_commands(tmp_path: Path) -> None:
    for name in ("first", "second"):
        _drive(tmp_path, name=name, duration=12)

    assert (tmp_path / "first.bag").read_bytes() == (tmp_path / "second.bag").read_bytes()
