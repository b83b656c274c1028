"""Client's handle of a sent goal."""

from typing import Any

from actionlib_msgs.msg import GoalID, GoalStatus

import rospy

from .comm_state import CommState

_TERMINAL = (
    GoalStatus.PREEMPTED,
    GoalStatus.SUCCEEDED,
    GoalStatus.ABORTED,
    GoalStatus.REJECTED,
    GoalStatus.RECALLED,
    GoalStatus.LOST,
)


class ClientGoalHandle:
    """Reads the state of one goal, and cancels it. The client forgets a goal when its last handle is deleted."""

    def __init__(self, comm_state_machine: Any) -> None:
        self.comm_state_machine = comm_state_machine

    def __eq__(self, o: Any) -> bool:
        return bool(o) and self.comm_state_machine == o.comm_state_machine

    def __ne__(self, o: object) -> bool:
        return not self == o

    def __hash__(self) -> int:
        return hash(self.comm_state_machine)

    def cancel(self) -> None:
        """Send a cancel request for the goal."""
        machine = self.comm_state_machine
        with machine.mutex:
            machine.send_cancel_fn(GoalID(stamp=rospy.Time(0), id=machine.action_goal.goal_id.id))
            machine.state = CommState.WAITING_FOR_CANCEL_ACK

    def get_comm_state(self) -> int:
        """CommState of the goal; LOST if the handle is empty."""
        if not self.comm_state_machine:
            rospy.logerr("get_comm_state of an empty ClientGoalHandle")
            return CommState.LOST
        return self.comm_state_machine.state

    def get_goal_status(self) -> int:
        """Number of the server's latest GoalStatus."""
        if not self.comm_state_machine:
            rospy.logerr("get_goal_status of an empty ClientGoalHandle")
            return GoalStatus.PENDING
        return self.comm_state_machine.latest_goal_status.status

    def get_goal_status_text(self) -> str:
        """Latest status text of the server."""
        if not self.comm_state_machine:
            rospy.logerr("get_goal_status_text of an empty ClientGoalHandle")
            return "ERROR: the handle has no goal"
        return self.comm_state_machine.latest_goal_status.text

    def get_result(self) -> Any:
        """The result, or None if there is none yet."""
        if not self.comm_state_machine:
            rospy.logerr("get_result of an empty ClientGoalHandle")
            return None
        latest = self.comm_state_machine.latest_result
        return latest.result if latest else None

    def get_terminal_state(self) -> int:
        """TerminalState of a goal that is DONE."""
        if not self.comm_state_machine:
            rospy.logerr("get_terminal_state of an empty ClientGoalHandle")
            return GoalStatus.LOST
        machine = self.comm_state_machine
        with machine.mutex:
            if machine.state != CommState.DONE:
                rospy.logwarn(f"get_terminal_state of a goal that is {CommState.to_string(machine.state)}")
            status = machine.latest_goal_status.status
            if status in _TERMINAL:
                return status
            rospy.logerr(f"get_terminal_state: {GoalStatus.to_string(status)} is not a terminal state")
            return GoalStatus.LOST
