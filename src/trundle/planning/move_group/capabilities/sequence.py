"""pilz_industrial_motion_planner's sequences: the action sequence_move_group and the service plan_sequence_path."""

import asyncio
import math
import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import msgspec
import numpy as np

from trundle.planning.planners import ErrorCode, RequestError, blended, joined
from trundle.planning.planning_scene import PlanningScene
from trundle.planning.trajectories import Trajectory
from trundle.ros import ActionResult, ActionServer

from ..controllers import JointPath
from ..error_codes import result_text
from ..plan_execution import execute_watched
from ..plan_outcome import PlanOutcome
from .preemption import preemptible

if TYPE_CHECKING:
    from trundle.ros import Message

    from ..move_group_context import MoveGroupContext

_MAX_ITEMS = 1000


def offer_sequence_service(context: "MoveGroupContext") -> None:
    """Advertise plan_sequence_path."""

    async def answer(request: "Message") -> dict[str, Any]:
        code, outcomes, seconds = await _plan(context, request.request)
        return {"response": _response(context, code, outcomes, seconds)}

    context.node.advertise_service("plan_sequence_path", "moveit_msgs/GetMotionSequence", answer)


def offer_sequence_action(context: "MoveGroupContext") -> None:
    """Advertise sequence_move_group."""

    async def execute(goal: "Message", accept: Callable[[], None]) -> ActionResult:
        accept()
        server.publish_feedback({"state": "PLANNING"}, goal=goal)
        code, outcomes, seconds = await _plan(context, goal.request)
        if code is ErrorCode.SUCCESS and not goal.planning_options.plan_only and context.execution is not None:
            server.publish_feedback({"state": "MONITOR"}, goal=goal)
            for outcome in outcomes:
                code = await execute_watched(context, outcome)
                if code is not ErrorCode.SUCCESS:
                    break
        server.publish_feedback({"state": "IDLE"}, goal=goal)
        text = result_text(code, is_empty=not outcomes, plan_only=bool(goal.planning_options.plan_only))
        result = {"response": _response(context, code, outcomes, seconds)}
        status = {ErrorCode.SUCCESS: "succeeded", ErrorCode.PREEMPTED: "preempted"}.get(code, "aborted")
        return ActionResult(status=status, result=result, text=text)  # pyright: ignore[reportArgumentType]

    work = preemptible(execute, field="response")
    server = ActionServer(context.node, "sequence_move_group", "moveit_msgs/MoveGroupSequence", work)


async def _plan(context: "MoveGroupContext", request: "Message") -> tuple[ErrorCode, list[PlanOutcome], float]:
    """Plan each item from where the last one ends; those of one group after each other become one path."""
    items = list(request.items)
    began = time.monotonic()
    radii = [float(item.blend_radius) for item in items]
    outcomes: list[PlanOutcome] = []
    positions: np.ndarray | None = None
    try:
        _check_radii(radii)
        for index, item in enumerate(items):
            wanted = item.req
            if positions is not None:
                state = context.state_fields(positions)
                wanted.start_state = context.node.new("moveit_msgs/RobotState", state)
            outcome = await context.plan(wanted, context.monitor.contents)
            if not outcome.is_success or outcome.path is None:
                raise RequestError(outcome.code, f"item {index} of the sequence: {outcome.sentence}")
            outcomes.append(outcome)
            positions = outcome.start.copy()
            positions[context.monitor.model.indices(outcome.path.joints)] = outcome.path.positions[-1]
            positions = context.monitor.model.with_mimics(positions)
        joined_outcomes = await asyncio.to_thread(_joined, context, outcomes, radii) if outcomes else []
    except RequestError as error:
        context.node.log.error(error.failure.sentence)
        return error.failure.error_code, [], time.monotonic() - began
    return ErrorCode.SUCCESS, joined_outcomes, time.monotonic() - began


def _check_radii(radii: list[float]) -> None:
    if len(radii) > _MAX_ITEMS:
        raise RequestError(ErrorCode.FAILURE, f"a sequence of {len(radii)} items; at most {_MAX_ITEMS}")
    if not all(0.0 <= radius < math.inf for radius in radii):
        raise RequestError(ErrorCode.INVALID_MOTION_PLAN, f"blend radii are not negative, got {radii}")
    if radii and radii[-1] != 0.0:
        raise RequestError(ErrorCode.INVALID_MOTION_PLAN, f"the last blend radius is 0, got {radii[-1]:g}")


def _joined(context: "MoveGroupContext", outcomes: list[PlanOutcome], radii: list[float]) -> list[PlanOutcome]:
    """Return the plans, those of one group after each other as one, blended where the radius is above 0."""
    merged = [outcomes[0]]
    corner: tuple[np.ndarray, float] | None = None
    """Place of the last blended corner, and its radius [m]."""
    for index, outcome in enumerate(outcomes[1:]):
        last, radius = merged[-1], radii[index]
        if outcome.group != last.group or last.path is None or outcome.path is None:
            if radius > 0.0:
                context.node.log.warn(f"item {index}: a blend radius between two groups is not used")
            merged.append(outcome)
            corner = None
            continue
        scene = context.pipelines.scene(context.monitor.contents, last.start)
        first, second = _trajectory(last.path), _trajectory(outcome.path)
        if radius > 0.0:
            corner = _check_overlap(context, scene, outcome, corner, radius)
            whole = blended(scene, outcome.group, last.start, first, second, radius)
        else:
            corner = None
            whole = joined(scene, outcome.group, first, second)
        path = JointPath(
            joints=last.path.joints,
            times_s=whole.times,
            positions=whole.positions,
            velocities=whole.velocities,
            accelerations=whole.accelerations,
        )
        merged[-1] = msgspec.structs.replace(last, path=path)
    return merged


def _check_overlap(
    context: "MoveGroupContext",
    scene: PlanningScene,
    outcome: PlanOutcome,
    corner: tuple[np.ndarray, float] | None,
    radius: float,
) -> tuple[np.ndarray, float]:
    """Return the place where a motion begins with its radius; the sphere of the corner before must be apart."""
    tips = context.monitor.model.group(outcome.group).tips
    place = np.array(scene.link_pose(tips[0], outcome.start).position) if tips else np.zeros(3)
    if corner is not None and np.linalg.norm(place - corner[0]) < corner[1] + radius:
        sentence = (
            f"overlapping blend radii: {corner[1]:g} and {radius:g} m, corners {math.dist(place, corner[0]):g} m apart"
        )
        raise RequestError(ErrorCode.INVALID_MOTION_PLAN, sentence)
    return place, radius


def _trajectory(path: JointPath) -> Trajectory:
    still = np.zeros_like(path.positions)
    return Trajectory(
        times=path.times_s,
        positions=path.positions,
        velocities=still if path.velocities is None else path.velocities,
        accelerations=still if path.accelerations is None else path.accelerations,
    )


def _response(
    context: "MoveGroupContext", code: ErrorCode, outcomes: list[PlanOutcome], seconds: float
) -> dict[str, Any]:
    fields: dict[str, Any] = {
        "error_code": {"val": int(code)},
        "planned_trajectories": [context.trajectory_fields(outcome.path) for outcome in outcomes],
        "planning_time": seconds,
    }
    if outcomes:
        fields["sequence_start"] = context.state_fields(outcomes[0].start)
    return fields
