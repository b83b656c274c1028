"""Inverse kinematics of six joints: share of reachable poses that are solved, and poses a second."""

import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np

from bench.table import Row
from trundle.planning.kinematics import InverseKinematics
from trundle.planning.robot_model import robot_model

_HERE = Path(__file__).parent
_ARM = _HERE.parent / "tests/data/arms/six_axis"
_POSES = 2000
_PARTS = 4
_PEER = "damped least squares in Python on Pinocchio, with restarts, without joint limits"


def run() -> list[Row]:
    """Solve the same poses from the same states, in alternation with the peer where PyPI has it."""
    urdf, srdf = (_ARM.with_suffix(f".{kind}").read_text() for kind in ("urdf", "srdf"))
    solver = InverseKinematics(robot_model(urdf, srdf), "arm")
    model, kinematics = solver.model, solver.kinematics
    rng = np.random.default_rng(1)
    states, seeds = (model.with_mimics(rng.uniform(model.lower, model.upper, (_POSES, len(model.lower)))) for _ in "ab")
    poses = kinematics.link_poses(states)[:, model.links.index(solver.tip)]
    with tempfile.TemporaryDirectory() as name:
        peer = _pinocchio(Path(name))
        ratios: list[float] = []
        times: list[float] = []
        solved = peer_solved = 0
        for part in range(_PARTS):
            own: list[float] = []
            for pose, seed in zip(poses[part::_PARTS], seeds[part::_PARTS], strict=True):
                start = time.perf_counter()
                found = solver.search(pose, seed)
                own.append(time.perf_counter() - start)
                solved += found.is_found
            times += own
            if peer is not None:
                request = {"poses": poses[part::_PARTS].tolist(), "seeds": seeds[part::_PARTS].tolist()}
                answer = peer({**request, "urdf": str(_ARM.with_suffix(".urdf")), "tip": solver.tip})
                ratios.append(answer["median_s"] / statistics.median(own))
                peer_solved += answer["solved"]
    ratio = statistics.median(ratios) if ratios else None
    share = solved / peer_solved if peer_solved else None
    return [
        Row("IK of six joints, solved", 100.0 * solved / _POSES, "%", _PEER, share),
        Row("IK of six joints, median", 1.0 / statistics.median(times), "poses/s", _PEER, ratio),
    ]


def _pinocchio(folder: Path) -> Any:
    """Install Pinocchio for the run; return a function that solves poses in a process, or None."""
    install = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--target", str(folder), "pin"]
    if subprocess.run([sys.executable, *install], capture_output=True, check=False).returncode != 0:
        return None
    env = {**os.environ, "PYTHONPATH": f"{folder}{os.pathsep}{folder / 'cmeel.prefix/lib/python3/site-packages'}"}

    def solve(request: dict[str, Any]) -> dict[str, Any]:
        command = [sys.executable, str(_HERE / "pinocchio_solver.py"), str(folder)]
        text = json.dumps(request)
        process = subprocess.run(command, input=text, env=env, capture_output=True, text=True, check=True)
        return json.loads(process.stdout)

    return solve
