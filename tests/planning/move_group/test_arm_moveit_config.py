"""The package arm_moveit_config, launched whole: plans and motions, and pick and place in physics."""

import math
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from bench.arm_goals import ArmCase, run_goals
from tests.graphs import free_port

from trundle.ros import GraphLoop, Node

_PATIENCE_S = 900.0
_TRAYS = {"red": (-0.2, 0.46), "green": (0.02, 0.52), "blue": (0.24, 0.52)}


@pytest.mark.slow
def test_random_goals_are_reached_without_collision(tmp_path: Path) -> None:
    case = ArmCase(launch=("arm_moveit_config demo.launch use_rviz:=false",), group="arm")

    found = run_goals(case, 30, tmp_path, limit_s=_PATIENCE_S)

    assert (found.goals, found.executed, found.faults) == (30, 30, ())


@pytest.mark.slow
def test_an_arm_sorts_blocks_by_color_in_physics(tmp_path: Path) -> None:
    """Every block ends on the tray of its color, seen by the camera and moved by move_group."""
    words = ["launch", "arm_moveit_config", "table.launch", "sort:=true", "gui:=false", "--headless"]
    port, log = free_port(), tmp_path / "launch.log"
    environment = {**os.environ, "ROS_HOME": str(tmp_path)}
    command = [sys.executable, "-m", "trundle", *words, "--port", str(port)]
    with log.open("w") as stream:
        launch = subprocess.Popen(command, env=environment, stdout=stream, stderr=subprocess.STDOUT)
    try:
        printed = _wait_sorted(launch, log)
        blocks = [f"{color}_{number}" for color in _TRAYS for number in (1, 2)]
        positions = dict(zip(blocks, _positions(port, blocks), strict=True))
    finally:
        launch.send_signal(signal.SIGINT)
        launch.wait(60)

    assert "sorted 6 of 6 blocks" in printed, printed
    for name, (x, y, z) in positions.items():
        tray_x, tray_y = _TRAYS[name.partition("_")[0]]
        assert abs(x - tray_x) < 0.08, (name, x, y)
        assert abs(y - tray_y) < 0.12, (name, x, y)
        assert math.isclose(z, 0.125, abs_tol=0.01), (name, z)


def _wait_sorted(launch: "subprocess.Popen[bytes]", log: Path) -> str:
    """Return the program's last line as soon as it is there."""
    end_s = time.monotonic() + _PATIENCE_S
    while time.monotonic() < end_s and launch.poll() is None:
        lines = [line for line in log.read_text(errors="replace").splitlines() if "]: sorted " in line]
        if lines:
            return lines[-1]
        time.sleep(0.5)
    pytest.fail(log.read_text(errors="replace")[-4000:])


def _positions(port: int, names: list[str]) -> list[tuple[float, float, float]]:
    """Ask Gazebo's service for the positions of models."""
    with GraphLoop() as loop:
        node = Node("/watcher", loop=loop, master_uri=f"http://127.0.0.1:{port}")
        found: list[tuple[float, float, float]] = []
        for name in names:
            asked = {"model_name": name, "relative_entity_name": "world"}
            call = node.call_service("/gazebo/get_model_state", "gazebo_msgs/GetModelState", asked, timeout_s=30.0)
            position = loop.run(call, 60.0).pose.position
            found.append((position.x, position.y, position.z))
        loop.run(node.shutdown(), 30.0)
    return found
