"""PTP, LIN and CIRC."""

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from trundle.base.diagnostics import UsageError
from trundle.planning import _planning
from trundle.planning.planning_scene import PlanningScene
from trundle.planning.trajectories import Trajectory, motion_limits, parameterize
from trundle.spatial import Pose

from ..cartesian_lines import NO_BOUNDS, follow, tip_of
from ..constraints import Constraints
from ..error_codes import ErrorCode, RequestError
from ..group_problem import GroupProblem
from ..requests import MotionPlan, MotionPlanRequest
from .cartesian_profile import timed_circle, timed_line

_GOAL_SAMPLES = 200
_Timed: TypeAlias = tuple[NDArray[np.float64], list[Pose]]


def plan_sequential(scene: PlanningScene, request: MotionPlanRequest) -> MotionPlan:
    """Plan one motion: from point to point, each joint at once; on a line; on an arc.

    The scalings of velocity and acceleration hold. A motion that touches something is none: these planners avoid
    nothing. CIRC's arc is given by a position constraint of the path constraints, which are called `interim` or
    `center`.

    Raises:
        RequestError: the motion is not possible.
    """
    kind = request.planner.upper()
    start = scene.model.with_mimics(
        np.asarray(scene.positions if request.start is None else request.start, dtype=np.float64)
    )
    if start.shape != (len(scene.model.variables),) or not np.isfinite(start).all():
        raise RequestError(ErrorCode.INVALID_ROBOT_STATE, "a start has a finite number for each variable")
    problem = GroupProblem(scene, request.group, start)
    if len(request.goals) != 1:
        raise RequestError(ErrorCode.INVALID_GOAL_CONSTRAINTS, f"{kind} goes to one goal, not {len(request.goals)}")
    if kind == "PTP":
        trajectory = _ptp(problem, request)
    else:
        trajectory = _cartesian(problem, request, kind)
    states = problem.state_of(trajectory.positions)
    whole = Trajectory(
        times=trajectory.times,
        positions=states,
        velocities=_widened(problem, trajectory.velocities),
        accelerations=_widened(problem, trajectory.accelerations),
    )
    return MotionPlan(group=request.group, planner=kind, waypoints=states, trajectory=whole)


def _ptp(problem: GroupProblem, request: MotionPlanRequest) -> Trajectory:
    start = np.ascontiguousarray(problem.reference[problem.indices])
    goal = _goal_state(problem, request)
    path = np.vstack([start, goal])
    turns = problem.dimensions[:, 2] > 0
    invalid = _planning.first_invalid(problem.scene.world, problem.task, path)
    if invalid >= 0:
        raise RequestError(ErrorCode.INVALID_MOTION_PLAN, "PTP: the motion is in collision; it avoids nothing")
    return parameterize(
        path,
        motion_limits(problem.model, problem.variables),
        velocity_scaling=request.velocity_scaling,
        acceleration_scaling=request.acceleration_scaling,
        turns=turns,
    )


def _goal_state(problem: GroupProblem, request: MotionPlanRequest) -> NDArray[np.float64]:
    start = np.ascontiguousarray(problem.reference[problem.indices])
    goal = problem.goal(request.goals[0])
    states = _planning.goal_states(problem.scene.world, problem.task, start, [goal], 1, _GOAL_SAMPLES, request.seed)
    if len(states):
        return states[0]
    free = GroupProblem(problem.scene, request.group, problem.reference, avoids_collisions=False)
    goal = free.goal(request.goals[0])
    if len(_planning.goal_states(free.scene.world, free.task, start, [goal], 1, _GOAL_SAMPLES, request.seed)):
        raise RequestError(ErrorCode.INVALID_MOTION_PLAN, f"{request.planner}: the goal is in collision")
    raise RequestError(ErrorCode.NO_IK_SOLUTION, f"group {request.group!r} reaches no valid state of the goal")


def _cartesian(problem: GroupProblem, request: MotionPlanRequest, kind: str) -> Trajectory:
    link, goal = _goal_pose(problem, request)
    start = problem.scene.link_pose(link, problem.reference)
    limits, velocity, acceleration = request.cartesian_limits, request.velocity_scaling, request.acceleration_scaling
    if not (0 < velocity <= 1 and 0 < acceleration <= 1):
        raise RequestError(
            ErrorCode.INVALID_MOTION_PLAN, f"{kind}: scalings are above 0, at most 1: {velocity}, {acceleration}"
        )
    if kind == "LIN":
        times, poses = timed_line(start, goal, limits, velocity, acceleration)
    else:
        point, is_center = _arc_point(problem, request.path_constraints)
        times, poses = timed_circle(start, goal, point, is_center, limits, velocity, acceleration)
    values, end = follow(problem, link, poses[1:], NO_BOUNDS)
    if end != "done":
        place = f"{kind}: after {len(values)} of {len(poses)} poses"
        if end == "unreachable":
            raise RequestError(ErrorCode.NO_IK_SOLUTION, f"{place} {link!r} cannot go on")
        raise RequestError(ErrorCode.INVALID_MOTION_PLAN, f"{place} the motion is in collision; it avoids nothing")
    return _with_velocities(problem, times, values, kind)


def _with_velocities(
    problem: GroupProblem, times: NDArray[np.float64], values: NDArray[np.float64], kind: str
) -> Trajectory:
    if len(values) < 2:
        return Trajectory(times=times, positions=values, velocities=values * 0.0, accelerations=values * 0.0)
    turns = problem.dimensions[:, 2] > 0
    values[:, turns] = np.unwrap(values[:, turns], axis=0)
    velocities = np.gradient(values, times, axis=0)
    velocities[[0, -1]] = 0.0
    limits = motion_limits(problem.model, problem.variables)
    steps = np.abs(np.diff(values, axis=0)) / np.diff(times)[:, None]
    over = steps / limits.velocity
    if over.max() > 1.0:
        step, variable = np.unravel_index(int(over.argmax()), over.shape)
        name, limit = problem.variables[int(variable)], limits.velocity[int(variable)]
        speed = steps[int(step), int(variable)]
        raise RequestError(
            ErrorCode.PLANNING_FAILED,
            f"{kind}: {name!r} would move at {speed:.3g}, its limit is {limit:.3g}; a smaller velocity scaling helps",
        )
    accelerations = np.gradient(velocities, times, axis=0)
    return Trajectory(times=times, positions=values, velocities=velocities, accelerations=accelerations)


def _goal_pose(problem: GroupProblem, request: MotionPlanRequest) -> tuple[str, Pose]:
    """Return the link that is moved and its pose at the goal."""
    (goal,) = request.goals
    if goal.joints and not goal.positions:
        state = problem.state_of(_goal_state(problem, request))
        link = tip_of(problem, None)
        return link, problem.scene.link_pose(link, state)
    if len(goal.positions) != 1 or len(goal.orientations) != 1 or not goal.positions[0].region:
        raise RequestError(
            ErrorCode.INVALID_GOAL_CONSTRAINTS, "a goal of LIN and CIRC is a position and an orientation, or joints"
        )
    (position,), (orientation,) = goal.positions, goal.orientations
    link = tip_of(problem, position.link)
    try:
        place = problem.scene.frame_pose(position.frame) @ position.region[0].pose
        turned = problem.scene.frame_pose(orientation.frame) @ Pose(quaternion=orientation.orientation)
    except UsageError as error:
        raise RequestError(ErrorCode.FRAME_TRANSFORM_FAILURE, str(error)) from None
    pose = Pose(place.position, turned.quaternion)
    return link, pose @ Pose((-position.offset[0], -position.offset[1], -position.offset[2]))


def _arc_point(problem: GroupProblem, constraints: Constraints) -> tuple[NDArray[np.float64], bool]:
    """Return CIRC's point, and whether it is the center."""
    if constraints.name not in ("interim", "center") or len(constraints.positions) != 1:
        raise RequestError(
            ErrorCode.INVALID_MOTION_PLAN,
            "CIRC needs path constraints called 'interim' or 'center' with one position constraint",
        )
    (position,) = constraints.positions
    if not position.region:
        raise RequestError(ErrorCode.INVALID_MOTION_PLAN, "CIRC: the position constraint has no region")
    try:
        pose = problem.scene.frame_pose(position.frame) @ position.region[0].pose
    except UsageError as error:
        raise RequestError(ErrorCode.FRAME_TRANSFORM_FAILURE, str(error)) from None
    return np.array(pose.position), constraints.name == "center"


def _widened(problem: GroupProblem, rates: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return rates (N, n) of the group as those of all variables; mimic joints move by their multipliers."""
    whole = np.zeros((len(rates), len(problem.reference)))
    whole[:, problem.indices] = rates
    model = problem.model
    for joint in model.joints:
        if joint.mimic is not None:
            whole[:, model.variable_index(joint.name)] = (
                joint.mimic.multiplier * whole[:, model.variable_index(joint.mimic.joint)]
            )
    return whole
