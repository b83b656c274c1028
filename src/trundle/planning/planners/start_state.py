"""Start states that are not valid, mended as MoveIt's FixStartStateBounds and FixStartStateCollision do."""

import numpy as np

from trundle.planning import _planning
from trundle.planning.planning_scene import PlanningScene

from .error_codes import ErrorCode, RequestError
from .group_problem import GroupProblem
from .requests import MotionPlanRequest, Positions

_VALID, _BEYOND, _VIOLATED = 0, 1, 2
_LISTED = 3


def fixed_bounds(scene: PlanningScene, request: MotionPlanRequest) -> tuple[Positions, list[str]]:
    """Return the start with variables that are a little beyond their limits put onto them, and what was changed.

    Raises:
        RequestError: no state, or a variable of the group that is farther beyond its limits.
    """
    model = scene.model
    start = np.array(scene.positions if request.start is None else request.start, dtype=np.float64)
    if start.shape != (len(model.variables),) or not np.isfinite(start).all():
        raise RequestError(
            ErrorCode.INVALID_ROBOT_STATE, f"a start has {len(model.variables)} finite numbers, one for each variable"
        )
    notes: list[str] = []
    for name in model.group(request.group).joints:
        joint = model.joint(name)
        for variable, lower, upper, is_bounded in zip(
            joint.variables, joint.lower, joint.upper, joint.is_bounded, strict=True
        ):
            index = model.variable_index(variable)
            value = float(start[index])
            if joint.type == "continuous" or (joint.type == "planar" and variable.endswith("theta") and not is_bounded):
                start[index] = value - 2 * np.pi * np.floor((value + np.pi) / (2 * np.pi))
            elif is_bounded and not lower <= value <= upper:
                beyond = max(lower - value, value - upper)
                if beyond > request.start_fixes.max_bounds_error:
                    limits = f"{lower:g} … {upper:g}"
                    raise RequestError(
                        ErrorCode.INVALID_ROBOT_STATE,
                        f"the start has {variable!r} at {value:g}, {beyond:.3g} beyond its limits {limits}",
                    )
                start[index] = min(max(value, lower), upper)
                if beyond > 1e-6:
                    notes.append(f"{variable!r} starts {beyond:.3g} beyond its limits; the path begins at the limit")
    return model.with_mimics(start), notes


def valid_start(problem: GroupProblem, request: MotionPlanRequest) -> tuple[Positions, list[str]]:
    """Return the group's values of a valid start: as it is, or moved a little out of a collision, and what was changed.

    Raises:
        RequestError: in collision or against the path constraints, and so is all that is near.
    """
    start = np.ascontiguousarray(problem.reference[problem.indices])
    world = problem.scene.world
    fault = _planning.fault_of(world, problem.task, start)
    if fault == _VALID:
        return start, []
    ranges = problem.dimensions[:, 1] - problem.dimensions[:, 0]
    radius = request.start_fixes.jiggle_fraction * float(np.median(ranges))
    attempts = request.start_fixes.max_sampling_attempts
    near = _planning.valid_near(world, problem.task, start, radius, attempts, request.seed)
    if near is not None:
        if fault == _VIOLATED:
            return near, ["the start is against the path constraints; the path begins beside it"]
        return near, [f"the start touches {_touching(problem)}; the path begins beside it"]
    if fault in (_BEYOND, _VIOLATED):
        raise RequestError(ErrorCode.START_STATE_VIOLATES_PATH_CONSTRAINTS, "the start is against the path constraints")
    raise RequestError(ErrorCode.START_STATE_IN_COLLISION, f"the start is in collision: {_touching(problem)}")


def _touching(problem: GroupProblem) -> str:
    contacts = problem.scene.check(problem.reference, group=problem.group.name, max_contacts=20)
    pairs = [f"{contact.body_1!r} with {contact.body_2!r}" for contact in contacts]
    more = f" and {len(pairs) - _LISTED} more" if len(pairs) > _LISTED else ""
    return ", ".join(pairs[:_LISTED]) + more
