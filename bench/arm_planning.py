"""Plans of an arm of seven joints in four scenes, against OMPL's RRT-Connect with the same collision check.

OMPL calls the check through Python, so its time has that in it; the number of states that each checks does not. OMPL's
paths are checked at steps of half a percent of the space, Trundle's between those, too.
"""

import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

from bench.arm_scenes import GROUP, SCENES, SEGMENT_FRACTION, arm_scene, queries
from bench.table import Row
from trundle.planning.planners import MotionPlan, MotionPlanRequest, PlannerSettings, joint_goal, plan

_COUNT = 100
_LIMIT_S = 5.0
_ROOT = Path(__file__).parents[1]
_OMPL = "ompl==1.7.0"


def run() -> list[Row]:
    """Plan a hundred queries in each scene; without OMPL's wheel, Trundle's alone."""
    rows: list[Row] = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        has_peer = _install(folder)
        for scene in SCENES:
            times, lengths, states, solved = _plans(scene)
            peer = _peer(folder, scene) if has_peer else None
            rows += _rows(scene, times, lengths, states, solved, peer)
    return rows


def _plans(name: str) -> tuple[list[float], list[float], list[int], int]:
    scene = arm_scene(name)
    times: list[float] = []
    lengths: list[float] = []
    states: list[int] = []
    for seed, (start, goal) in enumerate(queries(scene, name, _COUNT)):
        request = MotionPlanRequest(
            group=GROUP,
            start=start,
            goals=(joint_goal(dict(zip(scene.model.variables, goal.tolist(), strict=True))),),
            settings=PlannerSettings(longest_valid_segment_fraction=SEGMENT_FRACTION),
            allowed_time=_LIMIT_S,
            seed=seed,
        )
        began = time.perf_counter()
        result = plan(scene, request)
        times.append(time.perf_counter() - began)
        is_solved = isinstance(result, MotionPlan)
        lengths.append(float(np.linalg.norm(np.diff(result.waypoints, axis=0), axis=1).sum()) if is_solved else 0.0)
        states.append(result.statistics.states_checked if is_solved else 0)
    return times, lengths, states, sum(length > 0 for length in lengths)


def _rows(
    scene: str,
    times: list[float],
    lengths: list[float],
    states: list[int],
    solved: int,
    peer: list[tuple[float, float, int]] | None,
) -> list[Row]:
    name = f"arm, {scene}"
    against = "OMPL 1.7's RRTConnect, checks through Python"
    time_ratio = length_ratio = None
    if peer is not None:
        time_ratio = statistics.median(seconds for seconds, _, _ in peer) / statistics.median(times)
        both = [(length, other) for length, (_, other, _) in zip(lengths, peer, strict=True) if length and other]
        length_ratio = statistics.median(length / other for length, other in both)
        peer_solved = sum(length > 0 for _, length, _ in peer)
        peer_states = statistics.median(checked for _, _, checked in peer)
        against += f" ({peer_solved} of {len(peer)} solved, {peer_states:.0f} states)"
    return [
        Row(f"{name}: solved", 100.0 * solved / len(times), "%", "", None),
        Row(f"{name}: median", 1000 * statistics.median(times), "ms", f"speed of {against}", time_ratio),
        Row(f"{name}: states checked", statistics.median(states), "", "", None),
        Row(f"{name}: length", statistics.median(lengths), "rad", "the length of OMPL's paths", length_ratio),
    ]


def _install(folder: Path) -> bool:
    """Install OMPL for the run in addition to Trundle's environment; False: there is no wheel for this machine."""
    install = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--no-deps", "--target", str(folder)]
    return subprocess.run([sys.executable, *install, _OMPL], capture_output=True, check=False).returncode == 0


def _peer(folder: Path, scene: str) -> list[tuple[float, float, int]] | None:
    env = {**os.environ, "PYTHONPATH": os.pathsep.join([str(_ROOT), str(folder)])}
    command = [sys.executable, "-m", "bench.ompl_planner", scene, str(_COUNT)]
    process = subprocess.run(command, env=env, capture_output=True, text=True, check=False)
    return None if process.returncode else json.loads(process.stdout.splitlines()[-1])
