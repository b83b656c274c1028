"""Motion plans: requests answered by a path, or by why there is none."""

import time

import numpy as np

from trundle.planning import _planning
from trundle.planning.planning_scene import PlanningScene

from .error_codes import ErrorCode, PlanningFailure, RequestError
from .group_problem import GroupProblem
from .planner_names import ALGORITHMS, SEQUENTIAL, find_algorithm
from .requests import MotionPlan, MotionPlanRequest, PlanStatistics, Positions
from .start_state import fixed_bounds, valid_start

_MAX_SECONDS = 3600.0
_MAX_ATTEMPTS = 64


def plan(scene: PlanningScene, request: MotionPlanRequest) -> MotionPlan | PlanningFailure:
    """Plan a motion of a group without collision from its start to one of its goals.

    The scene is copied first, so that others may check it meanwhile. A path is checked between its waypoints, too: by
    the distance to what is near, so that no link enters anything by more than 0.1 mm. The same request and scene have
    the same answer, unless the time was too short.
    """
    try:
        if request.planner.upper() in SEQUENTIAL:
            from .pilz.sequential import plan_sequential

            return plan_sequential(scene.copy(), request)
        return _plan(scene.copy(), request)
    except RequestError as error:
        return error.failure


def _plan(scene: PlanningScene, request: MotionPlanRequest) -> MotionPlan | PlanningFailure:
    began = time.monotonic()
    if request.group not in scene.model.groups:
        GroupProblem(scene, request.group, scene.positions)  # raises
    if not request.goals:
        raise RequestError(ErrorCode.INVALID_GOAL_CONSTRAINTS, "a request needs a goal")
    original, notes_of_bounds = fixed_bounds(scene, request)
    problem = GroupProblem(
        scene,
        request.group,
        original,
        path_constraints=request.path_constraints,
        settings=request.settings,
        workspace=request.workspace,
    )
    notes_of_goals: list[str] = []
    goals = [problem.goal(goal, notes_of_goals) for goal in request.goals]
    start, moved = valid_start(problem, request)
    algorithm, note = find_algorithm(request.planner)
    notes = [*notes_of_bounds, *notes_of_goals, *moved, *([note] if note else [])]
    results: list[_planning.QueryResult] = []
    seconds = min(max(request.allowed_time, 0.0), _MAX_SECONDS)
    for attempt in range(min(max(request.attempts, 1), _MAX_ATTEMPTS)):
        remaining = seconds - (time.monotonic() - began)
        if attempt and remaining <= 0.0:
            break
        results.append(
            _planning.find_path(
                scene.world,
                problem.task,
                start,
                goals,
                ALGORITHMS[algorithm],
                request.settings.range,
                request.settings.goal_bias,
                request.settings.max_iterations,
                request.settings.max_goal_samples,
                request.settings.simplify,
                (request.seed + 7919 * attempt) % 2**64,
                remaining,
                request.cancel,
            )
        )
    found = [result for result in results if len(result.states)]
    if not found:
        return _failure(request, results[-1], seconds)
    best = min(found, key=lambda result: _length(result.states))
    waypoints = problem.state_of(best.states)
    if moved or notes_of_bounds:
        asked = scene.positions if request.start is None else request.start
        waypoints = np.vstack([scene.model.with_mimics(np.asarray(asked, dtype=np.float64)), waypoints])
    statistics = PlanStatistics(
        iterations=sum(result.iterations for result in results),
        states_checked=sum(result.checks for result in results),
        nodes=sum(result.nodes for result in results),
        goal_states=best.goals,
        attempts=len(results),
    )
    return MotionPlan(
        group=request.group, planner=algorithm, waypoints=waypoints, notes=tuple(notes), statistics=statistics
    )


def _length(states: Positions) -> float:
    return float(np.linalg.norm(np.diff(states, axis=0), axis=1).sum())


def _failure(request: MotionPlanRequest, result: _planning.QueryResult, seconds: float) -> PlanningFailure:
    group = f"group {request.group!r}"
    if request.cancel.is_cancelled:
        return PlanningFailure(ErrorCode.PREEMPTED, f"planning for {group} was ended")
    if result.goals == 0 and result.attempts:  # OMPL's planners fail for want of a goal, whatever the reason
        why = "none satisfied it"
        if result.in_collision:
            why = f"{result.in_collision} were in collision and {result.unreachable} did not satisfy it"
        return PlanningFailure(
            ErrorCode.PLANNING_FAILED,
            f"{group} reaches no goal: of {result.attempts} states sampled for the goal, {why}",
        )
    if result.seconds_left <= 0.0:
        return PlanningFailure(
            ErrorCode.TIMED_OUT, f"no path for {group} within {seconds:g} s, after {result.checks} states were checked"
        )
    return PlanningFailure(
        ErrorCode.PLANNING_FAILED, f"no path for {group} was found in {result.iterations} iterations"
    )
