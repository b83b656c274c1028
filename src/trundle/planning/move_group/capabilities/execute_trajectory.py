"""The action execute_trajectory, and the service execute_kinematic_path of Kinetic and before."""

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from trundle.base.diagnostics import TrundleError
from trundle.planning.planners import ErrorCode
from trundle.ros import ActionResult, ActionServer

from ..controllers import Outcome, path_from_message
from ..error_codes import result_text
from .preemption import preemptible

if TYPE_CHECKING:
    from trundle.ros import Message

    from ..move_group_context import MoveGroupContext

CODES = {
    Outcome.SUCCEEDED: ErrorCode.SUCCESS,
    Outcome.PREEMPTED: ErrorCode.PREEMPTED,
    Outcome.TIMED_OUT: ErrorCode.TIMED_OUT,
    Outcome.ABORTED: ErrorCode.CONTROL_FAILED,
    Outcome.FAILED: ErrorCode.CONTROL_FAILED,
}
_REFUSAL = "Cannot execute trajectory since ~allow_trajectory_execution was set to false"


def offer_execute_trajectory_action(context: "MoveGroupContext") -> None:
    """Advertise the action execute_trajectory."""

    async def execute(goal: "Message", accept: Callable[[], None]) -> ActionResult:
        accept()
        if context.execution is None:
            return _ended(ErrorCode.CONTROL_FAILED, _REFUSAL)
        context.node.log.info("Execution request received")
        server.publish_feedback({"state": "MONITOR"}, goal=goal)
        code = await run_trajectory(context, goal.trajectory)
        server.publish_feedback({"state": "IDLE"}, goal=goal)
        return _ended(code, result_text(code, is_empty=False, plan_only=False))

    server = ActionServer(context.node, "execute_trajectory", "moveit_msgs/ExecuteTrajectory", preemptible(execute))


def offer_execute_trajectory_service(context: "MoveGroupContext") -> None:
    """Advertise the service execute_kinematic_path."""

    async def answer(request: "Message") -> dict[str, Any]:
        context.node.log.info("Received new trajectory execution service request...")
        if context.execution is None:
            context.node.log.error(_REFUSAL)
            return {"error_code": {"val": int(ErrorCode.CONTROL_FAILED)}}
        if request.wait_for_execution:
            return {"error_code": {"val": int(await run_trajectory(context, request.trajectory))}}
        context.node.loop.spawn(run_trajectory(context, request.trajectory))
        context.node.log.info("Trajectory was successfully forwarded to the controller")
        return {"error_code": {"val": int(ErrorCode.SUCCESS)}}

    context.node.advertise_service("execute_kinematic_path", "moveit_msgs/ExecuteKnownTrajectory", answer)


async def run_trajectory(context: "MoveGroupContext", trajectory: "Message") -> ErrorCode:
    """Execute a moveit_msgs/RobotTrajectory; returns how it ended."""
    if context.execution is None:
        return ErrorCode.CONTROL_FAILED
    if len(trajectory.multi_dof_joint_trajectory.points):
        context.node.log.error("trajectories of planar and floating joints are not executed; no controller takes them")
        return ErrorCode.CONTROL_FAILED
    try:
        path = path_from_message(trajectory.joint_trajectory)
    except TrundleError as error:
        context.node.log.error(str(error))
        return ErrorCode.INVALID_MOTION_PLAN
    outcome = await context.execution.execute(path)
    context.node.log.info(f"Execution completed: {outcome.value}")
    return CODES[outcome]


def _ended(code: ErrorCode, text: str) -> ActionResult:
    status = {ErrorCode.SUCCESS: "succeeded", ErrorCode.PREEMPTED: "preempted"}.get(code, "aborted")
    return ActionResult(status=status, result={"error_code": {"val": int(code)}}, text=text)  # pyright: ignore[reportArgumentType]
