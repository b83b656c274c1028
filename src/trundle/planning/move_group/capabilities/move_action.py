"""The action move_group: plan, or plan and execute."""

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from trundle.base.diagnostics import TrundleError
from trundle.planning.planners import ErrorCode
from trundle.ros import ActionResult, ActionServer

from ..error_codes import result_text
from ..plan_execution import plan_and_execute
from ..plan_outcome import PlanOutcome
from ..scene import SceneContents, is_empty_state
from .preemption import preemptible

if TYPE_CHECKING:
    from trundle.ros import Message

    from ..move_group_context import MoveGroupContext


def offer_move_action(context: "MoveGroupContext") -> None:
    """Advertise the action move_group."""
    node = context.node

    async def execute(goal: "Message", accept: Callable[[], None]) -> ActionResult:
        accept()

        def report(state: str) -> None:
            server.publish_feedback({"state": state}, goal=goal)

        report("PLANNING")
        await context.monitor.state.wait_since(node.clock.now_ns())
        options = goal.planning_options
        plan_only = bool(options.plan_only) or context.execution is None
        if plan_only and not options.plan_only:
            node.log.warn(
                "This instance of MoveGroup is not allowed to execute trajectories but the goal request has plan_only "
                "set to false. Only a motion plan will be computed anyway."
            )
        try:
            changed = changed_scene(context, options.planning_scene_diff)
        except TrundleError as error:
            node.log.error(str(error))
            return ActionResult(
                status="aborted", result={"error_code": {"val": int(ErrorCode.FAILURE)}}, text=str(error)
            )
        if plan_only:
            node.log.info("Planning request received for MoveGroup action. Forwarding to planning pipeline.")
            contents = context.monitor.contents if changed is None else changed
            outcome = await context.plan(goal.request, contents)
        else:
            node.log.info(
                "Combined planning and execution request received for MoveGroup action. Forwarding to planning and "
                "execution pipeline."
            )
            outcome = await _plan_and_execute(context, goal, changed, report)
        report("IDLE")
        return _result(context, outcome, plan_only=bool(options.plan_only))

    server = ActionServer(node, "move_group", "moveit_msgs/MoveGroup", preemptible(execute))


def changed_scene(context: "MoveGroupContext", diff: "Message") -> SceneContents | None:
    """Return the scene with a goal's diff; None if the diff says nothing.

    Raises:
        TrundleError: a part of it is invalid.
    """
    world = diff.world
    says_something = (
        len(world.collision_objects)
        or len(world.octomap.octomap.data)
        or len(diff.robot_state.attached_collision_objects)
        or len(diff.allowed_collision_matrix.entry_names)
        or len(diff.allowed_collision_matrix.default_entry_names)
        or len(diff.link_padding)
        or len(diff.link_scale)
    )
    return context.monitor.changed_contents(diff) if says_something else None


async def _plan_and_execute(
    context: "MoveGroupContext", goal: "Message", changed: SceneContents | None, report: Callable[[str], None]
) -> PlanOutcome:
    options = goal.planning_options
    starts_elsewhere = not is_empty_state(goal.request.start_state)
    if starts_elsewhere:
        context.node.log.warn(
            "Execution of motions should always start at the robot's current state. Ignoring the state supplied as "
            "start state in the motion planning request"
        )

    async def plan() -> PlanOutcome:
        report("PLANNING")
        contents = context.monitor.contents if changed is None else changed
        return await context.plan(goal.request, contents, from_present=starts_elsewhere)

    return await plan_and_execute(
        context,
        plan,
        attempts=max(1, int(options.replan_attempts) or 5) if options.replan else 1,
        delay_s=float(options.replan_delay),
        before_execution=lambda: report("MONITOR"),
    )


def _result(context: "MoveGroupContext", outcome: PlanOutcome, *, plan_only: bool) -> ActionResult:
    is_empty = outcome.path is None or len(outcome.path.times_s) == 0
    text = result_text(outcome.code, is_empty=is_empty, plan_only=plan_only)
    fields: dict[str, Any] = {
        "error_code": {"val": int(outcome.code)},
        "planned_trajectory": context.trajectory_fields(outcome.path),
        "planning_time": outcome.planning_time_s,
    }
    if not is_empty:
        fields["trajectory_start"] = context.state_fields(outcome.start, context.monitor.contents)
    if outcome.code is ErrorCode.SUCCESS:
        return ActionResult(status="succeeded", result=fields, text=text)
    status = "preempted" if outcome.code is ErrorCode.PREEMPTED else "aborted"
    return ActionResult(status=status, result=fields, text=text)
