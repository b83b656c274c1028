"""The service plan_kinematic_path."""

from typing import TYPE_CHECKING, Any

from trundle.planning.planners import ErrorCode

from ..plan_outcome import PlanOutcome

if TYPE_CHECKING:
    from trundle.ros import Message

    from ..move_group_context import MoveGroupContext


def offer_plan_service(context: "MoveGroupContext") -> None:
    """Advertise plan_kinematic_path."""

    async def answer(request: "Message") -> dict[str, Any]:
        context.node.log.info("Received new planning service request...")
        wanted = request.motion_plan_request
        contents = context.monitor.contents
        outcome = await context.plan(wanted, contents)
        return {"motion_plan_response": plan_response(context, outcome)}

    context.node.advertise_service("plan_kinematic_path", "moveit_msgs/GetMotionPlan", answer)


def plan_response(context: "MoveGroupContext", outcome: PlanOutcome) -> dict[str, Any]:
    """Return the fields of a moveit_msgs/MotionPlanResponse."""
    fields: dict[str, Any] = {
        "error_code": {"val": int(outcome.code)},
        "group_name": outcome.group,
        "planning_time": outcome.planning_time_s,
        "trajectory": context.trajectory_fields(outcome.path),
    }
    if outcome.code is ErrorCode.SUCCESS:
        fields["trajectory_start"] = context.state_fields(outcome.start, context.monitor.contents)
    return fields
