"""Startup: wall time from the command to the first step, and to the car's first odometry."""

import os
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

from bench.table import Row
from trundle.ros import GraphLoop, Node

ROOT = Path(__file__).parents[1]
SEEDS = ROOT.parent / "shared/seeds"
_RUNS = 5
_PATIENCE_S = 30.0


def run() -> list[Row]:
    """Time whole processes; results of other tools are in bench/peers.py."""
    first_step = ("run", "model://rp2w", "--headless", "--no-ros", "--duration", "0.001")
    versions = [_wait("-m", "trundle", "--version") for _ in range(_RUNS)]
    pairs = [(_wait("-m", "trundle", *first_step), _wait("-c", "import numpy, mujoco")) for _ in range(_RUNS)]
    waits, ratios = [start for start, _ in pairs], [start / imports for start, imports in pairs]
    peer = "a Python that imports numpy and mujoco"
    rows = [
        Row("trundle --version, start to exit", statistics.median(versions), "s", "", None),
        Row("RP2W, start to first step and exit", statistics.median(waits), "s", peer, statistics.median(ratios)),
    ]
    if SEEDS.is_dir():
        cars = [_first_odometry() for _ in range(_RUNS)]
        rows.append(Row("smartcar, launch to first /odom", statistics.median(wait for wait, _ in cars), "s", "", None))
        rows.append(Row("smartcar, memory of all nodes", statistics.median(size for _, size in cars), "MB", "", None))
    return rows


def _wait(*arguments: str) -> float:
    """Return the wall time of a Python process with cached bytecode, as of an installed program [s]."""
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    start = time.perf_counter()
    subprocess.run([sys.executable, *arguments], check=True, capture_output=True, env=environment)
    return time.perf_counter() - start


def _first_odometry() -> tuple[float, float]:
    """Return the time from a launch to its first odometry [s], and the memory of all nodes [MB]."""
    received = threading.Event()
    port = 11400 + os.getpid() % 500
    uri = f"http://127.0.0.1:{port}"
    env = {**os.environ, "ROS_MASTER_URI": uri, "ROS_PACKAGE_PATH": str(SEEDS)}
    words = ("launch", "smartcar_description", "smartcar_display.rviz.launch", "--headless")
    with GraphLoop() as loop, tempfile.TemporaryFile() as output:
        listener = Node("/bench", loop=loop, master_uri=uri, rosout=False)
        listener.subscribe("/odom", "nav_msgs/Odometry", lambda _: received.set())
        start = time.perf_counter()
        process = subprocess.Popen([sys.executable, "-m", "trundle", *words], env=env, stdout=output, stderr=output)
        try:
            if not received.wait(_PATIENCE_S):
                raise RuntimeError(f"no /odom within {_PATIENCE_S:g} s")
            return time.perf_counter() - start, _resident_mb(process.pid)
        finally:
            process.terminate()
            process.wait()


def _resident_mb(pid: int) -> float:
    status = Path(f"/proc/{pid}/status").read_text(encoding="utf-8")
    return int(status.partition("VmRSS:")[2].split()[0]) / 1e3
