"""Solves poses on standard input by damped least squares on Pinocchio; prints how many, and the median time."""

import json
import site
import statistics
import sys
import time

site.addsitedir(sys.argv[1])  # its .pth file names the folder of the compiled module

import numpy as np
import pinocchio  # pyright: ignore

_ATTEMPTS = 20
_STEPS = 50
_DAMPING = 1e-4
_ERROR = 1e-5

request = json.load(sys.stdin)
model = pinocchio.buildModelFromUrdf(request["urdf"])
data = model.createData()
frame = model.getFrameId(request["tip"])
random = np.random.default_rng(2)


def solve(goal, q) -> bool:  # pyright: ignore
    for _ in range(_STEPS):
        pinocchio.framesForwardKinematics(model, data, q)
        offset = data.oMf[frame].actInv(goal)
        error = pinocchio.log6(offset).vector
        if np.abs(error).max() < _ERROR:
            return True
        jacobian = pinocchio.computeFrameJacobian(model, data, q, frame)
        jacobian = -pinocchio.Jlog6(offset.inverse()) @ jacobian
        q = q - jacobian.T @ np.linalg.solve(jacobian @ jacobian.T + _DAMPING * np.eye(6), error)
    return False


times, solved = [], 0
for row, q in zip(request["poses"], request["seeds"], strict=True):
    goal = pinocchio.SE3(pinocchio.Quaternion(row[6], *row[3:6]).matrix(), np.array(row[:3]))
    start = time.perf_counter()
    seeds = [np.array(q), *random.uniform(-3.1, 3.1, (_ATTEMPTS, len(q)))]
    solved += any(solve(goal, seed) for seed in seeds)
    times.append(time.perf_counter() - start)
print(json.dumps({"solved": solved, "median_s": statistics.median(times)}))
