"""The sentences that actions end with."""

from trundle.planning.planners import ErrorCode


def result_text(code: int, *, is_empty: bool, plan_only: bool) -> str:
    """Return the text with which move_group's actions end.

    Args:
        code: value of moveit_msgs/MoveItErrorCodes.
        is_empty: True if the planned trajectory has no points.
        plan_only: True if nothing was to be executed.
    """
    match code:
        case ErrorCode.SUCCESS:
            if is_empty:
                return "Requested path and goal constraints are already met."
            return "Motion plan was computed succesfully." if plan_only else "Solution was found and executed."
        case ErrorCode.INVALID_GROUP_NAME:
            return "Invalid group in motion plan request"
        case ErrorCode.PLANNING_FAILED | ErrorCode.INVALID_MOTION_PLAN:
            if is_empty:
                return "No motion plan found. No execution attempted."
            return "Motion plan was found but it seems to be invalid (possibly due to postprocessing). Not executing."
        case ErrorCode.UNABLE_TO_AQUIRE_SENSOR_DATA:
            return "Motion plan was found but it seems to be too costly and looking around did not help."
        case ErrorCode.MOTION_PLAN_INVALIDATED_BY_ENVIRONMENT_CHANGE:
            return "Solution found but the environment changed during execution and the path was aborted"
        case _:
            return ErrorCode(code).name if code in set(ErrorCode) else f"error code {code}"
