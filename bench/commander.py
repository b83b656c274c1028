"""Start of a moveit_commander program: wall time from the command to the pose of a group's tip.

The peer is a node of Debian's rospy that asks move_group one service, on the same graph; MoveIt's own module is not in
Debian.
"""

import os
import shutil
import signal
import socket
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Generator, Sequence
from contextlib import contextmanager
from pathlib import Path

import trundle
from bench.table import Row

_SITE = Path(trundle.__file__).parent / "ros/rospy/site"
_RUNS = 7
_START_S = 180.0
_READY = "You can start planning now!"
_LAUNCH = ("launch", "arm_moveit_config", "demo.launch", "use_rviz:=false", "--headless")
_PROGRAM = """import sys
import moveit_commander
import rospy
moveit_commander.roscpp_initialize(sys.argv)
rospy.init_node("bench", anonymous=True)
robot, scene = moveit_commander.RobotCommander(), moveit_commander.PlanningSceneInterface()
arm = moveit_commander.MoveGroupCommander("arm")
print(arm.get_current_pose().pose.position.z)
"""
_PEER = """import rospy
from std_srvs.srv import Empty
rospy.init_node("bench", anonymous=True)
rospy.wait_for_service("/clear_octomap")
rospy.ServiceProxy("/clear_octomap", Empty)()
"""
_DEBIAN_PYTHON = "/usr/bin/python3"


def run() -> list[Row]:
    """Alternate both programs on one graph; without Debian's rospy there is no ratio."""
    with tempfile.TemporaryDirectory() as name, _move_group(Path(name)) as uri:
        folder = Path(name)
        programs = {file: folder / file for file in ("commander.py", "peer.py")}
        programs["commander.py"].write_text(_PROGRAM, encoding="utf-8")
        programs["peer.py"].write_text(_PEER, encoding="utf-8")
        env = {**os.environ, "ROS_MASTER_URI": uri, "ROS_HOME": name}
        env.pop("PYTHONDONTWRITEBYTECODE", None)
        own, peer = {**env, "PYTHONPATH": str(_SITE)}, {**env, "PYTHONPATH": ""}
        has_peer = bool(shutil.which("rosmaster")) and Path(_DEBIAN_PYTHON).exists()
        times: list[float] = []
        ratios: list[float] = []
        for _ in range(_RUNS):
            times.append(_wait([sys.executable, str(programs["commander.py"])], own))
            if has_peer:
                ratios.append(times[-1] / _wait([_DEBIAN_PYTHON, str(programs["peer.py"])], peer))
    against = "a node of Debian's rospy that calls a service"
    ratio = statistics.median(ratios) if ratios else None
    return [Row("moveit_commander, start to a group's pose and exit", statistics.median(times), "s", against, ratio)]


def _wait(command: Sequence[str], env: dict[str, str]) -> float:
    """Return the wall time of a process [s]."""
    start = time.perf_counter()
    subprocess.run(command, check=True, capture_output=True, env=env)
    return time.perf_counter() - start


@contextmanager
def _move_group(folder: Path) -> Generator[str]:
    """Run move_group with fake controllers; gives the master's address."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = int(probe.getsockname()[1])
    uri, log = f"http://127.0.0.1:{port}", folder / "launch.log"
    env = {**os.environ, "ROS_MASTER_URI": uri, "ROS_HOME": str(folder)}
    with log.open("w", encoding="utf-8") as stream:
        command = [sys.executable, "-m", "trundle", *_LAUNCH, "--port", str(port)]
        launch = subprocess.Popen(command, env=env, stdout=stream, stderr=stream)
    try:
        end_s = time.monotonic() + _START_S
        while _READY not in log.read_text(errors="replace"):
            if launch.poll() is not None or time.monotonic() > end_s:
                raise RuntimeError(f"move_group did not start:\n{log.read_text(errors='replace')[-2000:]}")
            time.sleep(0.2)
        yield uri
    finally:
        launch.send_signal(signal.SIGINT)
        launch.wait(60)
