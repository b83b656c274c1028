"""States of a group whose link moves on straight lines, as MoveIt's CartesianInterpolator finds them."""

from collections.abc import Sequence

import numpy as np
from msgspec import Struct

from trundle.planning import _planning
from trundle.planning.planners import Constraints
from trundle.planning.planners.group_problem import GroupProblem
from trundle.planning.planning_scene import PlanningScene
from trundle.spatial import Pose, slerp

_TURN_PER_STEP = 5.0
"""Rotation of one step [rad] per metre of it; the original's resolution of rotations."""
_MIN_TURN = 0.05
_MAX_STATES = 100_000


class LineSettings(Struct, frozen=True, kw_only=True):
    """What a straight motion has to keep."""

    step_m: float
    """Distance between states [m]."""
    jump_threshold: float = 0.0
    """Greatest step of a state, as a multiple of the mean one; 0: any."""
    revolute_jump: float = 0.0
    """Greatest step of an angle [rad]; 0: any."""
    prismatic_jump: float = 0.0
    """Greatest step of a length [m]; 0: any."""
    avoid_collisions: bool = True
    path_constraints: Constraints = Constraints()


def follow_lines(
    scene: PlanningScene, group: str, link: str, start: np.ndarray, poses: Sequence[Pose], settings: LineSettings
) -> tuple[np.ndarray, float]:
    """Return states (n, variables of the model), the start first, and the share of the way that they cover.

    Args:
        scene: what must not be touched.
        group: group that moves.
        link: link that moves on the lines.
        start: state vector.
        poses: where the link goes, one after another, in the model's frame.
        settings: steps and limits.

    Raises:
        RequestError: no such group, or constraints that cannot be.
    """
    problem = GroupProblem(
        scene,
        group,
        start,
        path_constraints=settings.path_constraints,
        avoids_collisions=settings.avoid_collisions,
    )
    model = scene.model
    rows = _samples(scene.link_pose(link, start), poses, settings.step_m)
    if not len(rows):
        return np.array(start)[None, :], 1.0
    slides = np.array([model.has_joint(name) and model.joint(name).type == "prismatic" for name in problem.variables])
    states, _ = _planning.follow_poses(
        scene.world,
        problem.task,
        np.ascontiguousarray(np.asarray(start, dtype=np.float64)[problem.indices]),
        model.links.index(link),
        np.zeros(3),
        rows,
        slides,
        settings.revolute_jump,
        settings.prismatic_jump,
    )
    whole = np.vstack([start, problem.state_of(states)]) if len(states) else np.array(start)[None, :]
    count = _before_jump(whole[:, problem.indices], settings.jump_threshold)
    return whole[: count + 1], count / len(rows)


def _samples(here: Pose, poses: Sequence[Pose], step_m: float) -> np.ndarray:
    """Return poses (n, 7), x y z qx qy qz qw, along the lines, without the first."""
    rows: list[tuple[float, ...]] = []
    for there in poses:
        length = float(np.linalg.norm(np.subtract(there.position, here.position)))
        w = min(1.0, abs(float(np.dot(here.quaternion, there.quaternion))))
        turn = 2.0 * float(np.arccos(w))
        count = max(1, int(np.ceil(length / step_m)), int(np.ceil(turn / max(_TURN_PER_STEP * step_m, _MIN_TURN))))
        if length < 1e-9 and turn < 1e-6:
            continue
        for index in range(1, min(count, _MAX_STATES - len(rows)) + 1):
            share = index / count
            qw, qx, qy, qz = slerp(here.quaternion, there.quaternion, share)
            x, y, z = np.add(np.multiply(here.position, 1.0 - share), np.multiply(there.position, share)).tolist()
            rows.append((x, y, z, qx, qy, qz, qw))
        here = there
    return np.array(rows, dtype=np.float64).reshape(-1, 7)


def _before_jump(states: np.ndarray, threshold: float) -> int:
    """Return the number of steps before one that is longer than a multiple of the mean."""
    steps = np.abs(np.diff(states, axis=0)).sum(axis=1)
    if threshold <= 0.0 or len(steps) < 10:  # the original checks no shorter paths
        return len(steps)
    jumps = np.flatnonzero(steps > threshold * steps.mean())
    return int(jumps[0]) if len(jumps) else len(steps)
