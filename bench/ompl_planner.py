"""OMPL's RRT-Connect on a scene of `arm_scenes`, in a process of its own; prints times, lengths and states as JSON.

Its states are checked by Trundle's collision check, called from Python: OMPL's time has that call in it. It checks
motions at steps only, and simplifies as MoveIt lets it.
"""

import json
import sys
import time
from typing import Any

import numpy as np
from ompl import base, geometric, util  # pyright: ignore

from bench.arm_scenes import SEGMENT_FRACTION, arm_scene, queries

_LIMIT_S = 5.0


def main(name: str, count: int) -> None:
    """Plan the queries of a scene."""
    util.noOutputHandler()
    util.RNG.setSeed(1)
    scene = arm_scene(name)
    model = scene.model
    n = len(model.variables)
    space = base.RealVectorStateSpace(n)
    bounds = base.RealVectorBounds(n)
    for i in range(n):
        bounds.setLow(i, float(model.lower[i]))
        bounds.setHigh(i, float(model.upper[i]))
    space.setBounds(bounds)
    buffer = np.zeros(n)
    links = scene.mask("arm")
    checked = 0

    def is_valid(state: Any) -> bool:
        nonlocal checked
        checked += 1
        for i in range(n):
            buffer[i] = state[i]
        return scene.world.is_free(buffer, links)

    rows: list[tuple[float, float, int]] = []
    for start, goal in queries(scene, name, count):
        setup = geometric.SimpleSetup(space)
        setup.setStateValidityChecker(base.StateValidityCheckerFn(is_valid))
        setup.getSpaceInformation().setStateValidityCheckingResolution(SEGMENT_FRACTION)
        setup.setPlanner(geometric.RRTConnect(setup.getSpaceInformation()))
        ends = [base.State(space), base.State(space)]
        for end, values in zip(ends, (start, goal), strict=True):
            for i in range(n):
                end[i] = float(values[i])
        setup.setStartAndGoalStates(*ends)
        checked, began = 0, time.perf_counter()
        is_solved = setup.solve(_LIMIT_S).asString() == "Exact solution"
        if is_solved:
            setup.simplifySolution()
        seconds = time.perf_counter() - began
        rows.append((seconds, setup.getSolutionPath().length() if is_solved else 0.0, checked))
    print(json.dumps(rows), flush=True)


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]))
    sys.stdout.close()
    import os

    os._exit(0)  # OMPL's own objects end the process with a fault
