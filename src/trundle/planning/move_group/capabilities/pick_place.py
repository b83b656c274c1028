"""The actions pickup and place."""

import asyncio
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from trundle.base.diagnostics import TrundleError
from trundle.planning.planners import ErrorCode
from trundle.ros import ActionResult, ActionServer

from ..error_codes import result_text
from ..manipulation import (
    Failure,
    ManipulationGoal,
    Stage,
    execute_stages,
    pick_goals,
    place_goals,
    plan_manipulation,
)
from .move_action import changed_scene
from .preemption import preemptible

if TYPE_CHECKING:
    from trundle.ros import Message

    from ..move_group_context import MoveGroupContext
    from ..scene import Frames, SceneContents

    _Read = Callable[[MoveGroupContext, Message, SceneContents, Frames], list[ManipulationGoal]]

_DEFAULT_TIME_S = 5.0


def offer_pick_place(context: "MoveGroupContext") -> None:
    """Advertise the actions pickup and place."""
    _offer(context, "pickup", "moveit_msgs/Pickup", pick_goals, _pick_fields)
    _offer(context, "place", "moveit_msgs/Place", place_goals, _place_fields)


def _pick_fields(goal: "Message", attempt: ManipulationGoal) -> dict[str, Any]:
    return {"grasp": goal.possible_grasps[attempt.number]} if len(goal.possible_grasps) else {}


def _place_fields(goal: "Message", attempt: ManipulationGoal) -> dict[str, Any]:
    return {"place_location": goal.place_locations[attempt.number]}


def _offer(
    context: "MoveGroupContext",
    name: str,
    kind: str,
    read: "_Read",
    chosen_fields: Callable[["Message", ManipulationGoal], dict[str, Any]],
) -> None:
    node = context.node

    async def execute(goal: "Message", accept: Callable[[], None]) -> ActionResult:
        accept()

        def report(state: str) -> None:
            server.publish_feedback({"state": state}, goal=goal)

        report("PLANNING")
        await context.monitor.state.wait_since(node.clock.now_ns())
        start_ns = node.clock.now_ns()
        found = await _plan(context, goal, read)
        if isinstance(found, Failure):
            node.log.error(f"{name}: {found.sentence}")
            text = result_text(found.code, is_empty=True, plan_only=False)
            return ActionResult(
                status="aborted", result={"error_code": {"val": int(found.code)}}, text=f"{text} {found.sentence}"
            )
        attempt, stages = found
        code = ErrorCode.SUCCESS
        plan_only = bool(goal.planning_options.plan_only) or context.execution is None
        if not plan_only:
            report("MONITOR")
            code = await execute_stages(context, attempt, stages, lambda _: None)
        report("IDLE")
        fields: dict[str, Any] = {
            "error_code": {"val": int(code)},
            "trajectory_start": context.state_fields(stages[0].start),
            "trajectory_stages": [context.trajectory_fields(stage.path) for stage in stages],
            "trajectory_descriptions": [stage.description for stage in stages],
            "planning_time": (node.clock.now_ns() - start_ns) / 1e9,
            **chosen_fields(goal, attempt),
        }
        text = result_text(code, is_empty=False, plan_only=plan_only)
        status = {ErrorCode.SUCCESS: "succeeded", ErrorCode.PREEMPTED: "preempted"}.get(code, "aborted")
        return ActionResult(status=status, result=fields, text=text)  # pyright: ignore[reportArgumentType]

    server = ActionServer(node, name, kind, preemptible(execute))


async def _plan(
    context: "MoveGroupContext", goal: "Message", read: "_Read"
) -> tuple[ManipulationGoal, list[Stage]] | Failure:
    """Return the first manipulation that is possible, with its stages."""
    monitor = context.monitor
    start = monitor.positions()
    try:
        changed = changed_scene(context, goal.planning_options.planning_scene_diff)
        contents = monitor.contents if changed is None else changed
        attempts = read(context, goal, contents, monitor.frames(start, contents))
    except (TrundleError, ValueError) as error:
        return Failure(code=ErrorCode.INVALID_OBJECT_NAME, sentence=str(error))
    time_s = float(goal.allowed_planning_time) or _DEFAULT_TIME_S
    failure = Failure(code=ErrorCode.PLANNING_FAILED, sentence="there is nothing to try")
    end_ns = context.node.clock.now_ns() + round(time_s * 1e9)
    with context.node.loop.work.pending("a plan"):
        for index, attempt in enumerate(attempts):
            if index and context.node.clock.now_ns() > end_ns:
                tried = f"{index} of {len(attempts)} ways were tried in {time_s:g} s"
                return Failure(code=ErrorCode.TIMED_OUT, sentence=f"{tried}; the last: {failure.sentence}")
            found = await asyncio.to_thread(
                plan_manipulation, context, attempt, start, planner_id=str(goal.planner_id), planning_time_s=time_s
            )
            if not isinstance(found, Failure):
                context.node.log.info(f"Found successful manipulation plan: number {attempt.number}")
                return attempt, found
            failure = found
            context.node.log.info(f"Manipulation plan {attempt.number} failed: {found.sentence}")
    return Failure(
        code=failure.code, sentence=f"none of {len(attempts)} ways is possible; the last: {failure.sentence}"
    )
