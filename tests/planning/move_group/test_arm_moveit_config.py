"""The package arm_moveit_config, launched whole: plans and motions, and pick and place in physics."""

import math
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from tests.planning.move_group.arm_goals import run

from trundle.ros import Messages, open_bag

_TRAYS = {"red": (-0.2, 0.46), "green": (0.02, 0.52), "blue": (0.24, 0.52)}


@pytest.mark.slow
def test_random_goals_are_reached_without_collision(tmp_path: Path) -> None:
    words = ["arm_moveit_config", "demo.launch", "use_rviz:=false", "fake_execution_type:=last point"]

    figures = run(words, goals=30, folder=tmp_path)

    assert figures["goals"] == 30
    assert figures["executed"] >= 30 * 0.98
    assert figures["collisions"] == figures["beyond_limits"] == 0


@pytest.mark.slow
def test_an_arm_sorts_blocks_by_color_in_physics(tmp_path: Path) -> None:
    """Every block ends on the tray of its color, seen by the camera and moved by move_group."""
    bag = tmp_path / "run.bag"
    words = ["launch", "arm_moveit_config", "table.launch", "sort:=true", "gui:=false", "--headless", "--port", "0"]
    environment = {**os.environ, "ROS_HOME": str(tmp_path)}
    command = [sys.executable, "-m", "trundle", *words, "--duration", "150", "--record", str(bag)]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False, timeout=1500)

    assert "sorted 6 of 6 blocks" in done.stdout + done.stderr, (done.stdout + done.stderr)[-4000:]
    last: Any = None
    library = Messages()
    with open_bag(bag) as reader:
        for item in reader.messages():
            if item.connection.topic == "/gazebo/model_states":
                last = item
    assert last is not None
    states = library.deserialize(last.data, last.connection.type)
    poses = dict(zip(states.name, states.pose, strict=True))
    for name, pose in poses.items():
        color = name.partition("_")[0]
        if name.endswith(("_1", "_2")):
            x, y = _TRAYS[color]
            assert max(abs(pose.position.x - x), abs(pose.position.y - y)) < 0.08, (name, pose)
            assert math.isclose(pose.position.z, 0.125, abs_tol=0.01), (name, pose)
