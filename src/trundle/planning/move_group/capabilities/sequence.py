"""pilz_industrial_motion_planner's sequences: the action sequence_move_group and the service plan_sequence_path."""

import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from trundle.planning.planners import ErrorCode
from trundle.ros import ActionResult, ActionServer

from ..error_codes import result_text
from ..plan_execution import execute_watched
from ..plan_outcome import PlanOutcome

if TYPE_CHECKING:
    from trundle.ros import Message

    from ..context import Context

_MAX_ITEMS = 1000


def offer_sequence_service(context: "Context") -> None:
    """Advertise plan_sequence_path."""

    async def answer(request: "Message") -> dict[str, Any]:
        code, outcomes, seconds = await _plan(context, request.request)
        return {"response": _response(context, code, outcomes, seconds)}

    context.node.advertise_service("plan_sequence_path", "moveit_msgs/GetMotionSequence", answer)


def offer_sequence_action(context: "Context") -> None:
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

    server = ActionServer(context.node, "sequence_move_group", "moveit_msgs/MoveGroupSequence", execute)


async def _plan(context: "Context", request: "Message") -> tuple[ErrorCode, list[PlanOutcome], float]:
    """Plan each item from where the last one of its group ends; blends are stops."""
    items = list(request.items)
    began = time.monotonic()
    if len(items) > _MAX_ITEMS:
        context.node.log.error(f"a sequence of {len(items)} items; at most {_MAX_ITEMS}")
        return ErrorCode.FAILURE, [], 0.0
    if any(float(item.blend_radius) > 0.0 for item in items):
        context.node.log.warn("blend radii are not used: the motion stops at each point of the sequence")
    outcomes: list[PlanOutcome] = []
    positions: np.ndarray | None = None
    for index, item in enumerate(items):
        wanted = item.req
        if positions is not None:
            state = context.state_fields(positions)
            wanted.start_state = context.node.new("moveit_msgs/RobotState", state)
        outcome = await context.plan(wanted, context.monitor.contents)
        if not outcome.is_success or outcome.path is None:
            context.node.log.error(f"item {index} of the sequence: {outcome.sentence}")
            return outcome.code, [], time.monotonic() - began
        outcomes.append(outcome)
        positions = outcome.start.copy()
        positions[context.monitor.model.indices(outcome.path.joints)] = outcome.path.positions[-1]
        positions = context.monitor.model.with_mimics(positions)
    return ErrorCode.SUCCESS, outcomes, time.monotonic() - began


def _response(context: "Context", code: ErrorCode, outcomes: list[PlanOutcome], seconds: float) -> dict[str, Any]:
    fields: dict[str, Any] = {
        "error_code": {"val": int(code)},
        "planned_trajectories": [context.trajectory_fields(outcome.path) for outcome in outcomes],
        "planning_time": seconds,
    }
    if outcomes:
        fields["sequence_start"] = context.state_fields(outcomes[0].start)
    return fields
