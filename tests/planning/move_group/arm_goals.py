"""Random goals of an arm: planned, executed by fake controllers, and checked between their points.

`python -m tests.planning.move_group.arm_goals PACKAGE demo.launch [ARGUMENT:=VALUE …] [--group GROUP] [--goals 50]`
starts the launch file of any MoveIt configuration on ROS_PACKAGE_PATH, and prints a line of a table.
"""

import argparse
import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

from tests.graphs import free_port

import trundle

_SITE = Path(trundle.__file__).parent / "ros/rospy/site"
_PROGRAM = Path(__file__).parents[2] / "data/arms/random_goals.py"
_READY = "You can start planning now!"
_START_S = 180.0


def run(words: list[str], *, group: str = "", goals: int = 50, folder: Path) -> dict[str, Any]:
    """Launch a configuration, and plan and execute random goals; returns figures.

    Args:
        words: package or file, launch file, arguments.
        group: group that is planned; empty: the first that is a chain with joints.
        goals: number of valid goals.
        folder: for logs.

    Raises:
        RuntimeError: move_group did not start, or the goals' program failed.
    """
    port = free_port()
    environment = {**os.environ, "ROS_HOME": str(folder), "ROS_MASTER_URI": f"http://127.0.0.1:{port}"}
    log = folder / "launch.log"
    command = [sys.executable, "-m", "trundle", "launch", *words, "--headless", "--port", str(port)]
    with log.open("w") as stream:
        launch = subprocess.Popen(command, env=environment, stdout=stream, stderr=subprocess.STDOUT)
    try:
        end_s = time.monotonic() + _START_S
        while _READY not in log.read_text(errors="replace"):
            if launch.poll() is not None or time.monotonic() > end_s:
                raise RuntimeError(f"move_group did not start:\n{log.read_text(errors='replace')[-3000:]}")
            time.sleep(0.2)
        program = [sys.executable, str(_PROGRAM), group, str(goals)]
        child = {**environment, "PYTHONPATH": str(_SITE)}
        done = subprocess.run(program, env=child, capture_output=True, text=True, check=False, timeout=3000)
    finally:
        launch.send_signal(signal.SIGINT)
        launch.wait(60)
    lines = [line for line in done.stdout.splitlines() if line.startswith("{")]
    if done.returncode or not lines:
        raise RuntimeError(f"the goals' program failed:\n{done.stdout[-2000:]}\n{done.stderr[-3000:]}")
    return json.loads(lines[-1])


def _main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("words", nargs="+")
    parser.add_argument("--group", default="")
    parser.add_argument("--goals", type=int, default=50)
    parser.add_argument("--folder", type=Path, default=Path("/tmp/arm_goals"))
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    print(json.dumps(run(options.words, group=options.group, goals=options.goals, folder=options.folder)))


if __name__ == "__main__":
    _main()
