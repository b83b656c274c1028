"""Paths along straight lines of a link, as MoveIt's computeCartesianPath."""

from collections.abc import Sequence
from typing import Literal, TypeAlias

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from trundle.base.diagnostics import UsageError
from trundle.planning import _planning
from trundle.planning.planning_scene import PlanningScene, pose_row
from trundle.spatial import Pose, slerp

from .constraints import Constraints
from .error_codes import ErrorCode, RequestError
from .group_problem import NO_CONSTRAINTS, GroupProblem
from .requests import Positions

PathEnd: TypeAlias = Literal["done", "unreachable", "invalid", "jump"]
_ENDS: tuple[PathEnd, ...] = ("done", "unreachable", "invalid", "jump")
_TURN_PER_METRE = 3.5
"""Greatest turn per length of a step [rad/m]: MoveIt's MaxEEFStep."""
_MIN_STEPS = 10
"""Least number of steps of a whole path with a relative bound on jumps, whose mean would mean nothing otherwise."""
_MAX_STEPS = 100_000


class CartesianPath(Struct, frozen=True, kw_only=True, eq=False):
    """States along a path of poses."""

    waypoints: Positions
    """(N, len(model.variables)) states, the start first."""
    fraction: float
    """Part of the path that is followed, from 0 to 1."""
    end: PathEnd
    """Why it ends: all is followed, a pose is out of reach, a state or motion is not valid, a variable jumps."""


class JumpBounds(Struct, frozen=True, kw_only=True):
    """Bounds of steps of the group's variables, beyond which an arm would flip over; 0: any."""

    relative: float = 0.0
    """Greatest step as a multiple of the mean one."""
    revolute: float = 0.0
    """[rad]"""
    prismatic: float = 0.0
    """[m]"""


NO_BOUNDS = JumpBounds()


def interpolated_poses(start: Pose, poses: Sequence[Pose], max_step: float, least: int = 1) -> list[Pose]:
    """Return poses on the lines from one pose to the next, the start left out.

    Args:
        start: first pose.
        poses: ends of the lines.
        max_step: greatest distance from one to the next [m]; the greatest turn is 3.5 rad/m times that.
        least: least number of poses on each line.

    Raises:
        UsageError: too many.
    """
    made: list[Pose] = []
    for pose in poses:
        away = float(np.linalg.norm(np.subtract(pose.position, start.position)))
        turn = 2.0 * np.arccos(min(1.0, abs(float(np.dot(pose.quaternion, start.quaternion)))))
        wanted = max(away / max_step, turn / (_TURN_PER_METRE * max_step), least)
        if len(made) + wanted > _MAX_STEPS:
            raise UsageError(f"a path of more than {_MAX_STEPS} steps of {max_step:g} m; longer steps help")
        count = max(1, int(np.ceil(wanted - 1e-9)))
        for i in range(1, count + 1):
            t = i / count
            x, y, z = ((1 - t) * a + t * b for a, b in zip(start.position, pose.position, strict=True))
            made.append(Pose((x, y, z), slerp(start.quaternion, pose.quaternion, t)))
        start = pose
    return made


def cartesian_path(
    scene: PlanningScene,
    group: str,
    poses: Sequence[Pose],
    *,
    link: str | None = None,
    start: Positions | None = None,
    max_step: float = 0.01,
    jumps: JumpBounds = NO_BOUNDS,
    avoid_collisions: bool = True,
    path_constraints: Constraints = NO_CONSTRAINTS,
) -> CartesianPath:
    """Follow straight lines with a link as far as possible.

    Args:
        scene: scene, which is not changed.
        group: group that moves.
        poses: poses of the link in the model frame, one after another.
        link: link; None: the group's tip.
        start: state of all variables; None: the scene's.
        max_step: greatest distance from one state to the next [m].
        jumps: bounds beyond which a step is none.
        avoid_collisions: False: only limits and constraints count.
        path_constraints: constraints that hold on the whole path.

    Raises:
        RequestError: no such group or link, no step, or constraints that cannot be.
    """
    scene = scene.copy()
    state = scene.model.with_mimics(np.asarray(scene.positions if start is None else start, dtype=np.float64))
    if state.shape != (len(scene.model.variables),) or not np.isfinite(state).all():
        raise RequestError(
            ErrorCode.INVALID_ROBOT_STATE, f"a start has {len(scene.model.variables)} finite numbers, one per variable"
        )
    problem = GroupProblem(scene, group, state, path_constraints=path_constraints, avoids_collisions=avoid_collisions)
    tip = tip_of(problem, link)
    if not (max_step > 0 and np.isfinite(max_step)):
        raise RequestError(ErrorCode.INVALID_GOAL_CONSTRAINTS, f"a step is above zero, got {max_step:g} m")
    least = -(-_MIN_STEPS // len(poses)) if jumps.relative > 0 and poses else 1
    try:
        for pose in poses:
            pose_row(pose)
        targets = interpolated_poses(scene.link_pose(tip, state), poses, max_step, least)
    except UsageError as error:
        raise RequestError(ErrorCode.INVALID_GOAL_CONSTRAINTS, str(error)) from None
    values, end = follow(problem, tip, targets, jumps)
    kept = _without_jump(values, jumps.relative)
    if kept < len(values):
        values, end = values[:kept], "jump"
    fraction = 1.0 if not targets else (len(values) - 1) / len(targets)
    return CartesianPath(waypoints=problem.state_of(values), fraction=fraction, end=end)


def tip_of(problem: GroupProblem, link: str | None) -> str:
    """Return a link, or the group's tip.

    Raises:
        RequestError: no such link, or the group has no tip, or several.
    """
    if link is None:
        if len(problem.group.tips) != 1:
            tips = ", ".join(map(repr, problem.group.tips)) or "none"
            raise RequestError(
                ErrorCode.INVALID_LINK_NAME,
                f"group {problem.group.name!r} has no single tip (tips: {tips}); name a link",
            )
        return problem.group.tips[0]
    problem.link_number(link)
    return link


def follow(
    problem: GroupProblem, link: str, poses: Sequence[Pose], jumps: JumpBounds
) -> tuple[NDArray[np.float64], PathEnd]:
    """Return the group's values (N, n) along poses of a link, the start first, and why they end."""
    start = np.ascontiguousarray(problem.reference[problem.indices])
    kinds = [problem.model.joint(name) for name in problem.group.joints]
    slides = np.array([joint.type == "prismatic" for joint in kinds for _ in joint.variables], dtype=np.bool_)
    rows = np.array([pose_row(pose) for pose in poses], dtype=np.float64).reshape(-1, 7)
    values, end = _planning.follow_poses(
        problem.scene.world,
        problem.task,
        start,
        problem.link_number(link),
        np.zeros(3),
        rows,
        slides,
        max(jumps.revolute, 0.0),
        max(jumps.prismatic, 0.0),
    )
    return np.vstack([start, values]), _ENDS[end]


def _without_jump(values: NDArray[np.float64], relative: float) -> int:
    """Return the number of states before a step that is more than `relative` times the mean one."""
    steps = np.abs(np.diff(values, axis=0)).sum(axis=1)
    if relative <= 0 or not len(steps):
        return len(values)
    jumps = np.flatnonzero(steps > relative * steps.mean())
    return int(jumps[0]) + 1 if len(jumps) else len(values)
