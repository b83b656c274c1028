"""State of one goal at its client."""

import threading
from collections.abc import Callable
from typing import Any

from actionlib_msgs.msg import GoalStatus, GoalStatusArray

import rospy

from .client_goal_handle import ClientGoalHandle
from .comm_state import CommState, next_states

_UNLISTED = (CommState.WAITING_FOR_GOAL_ACK, CommState.WAITING_FOR_RESULT, CommState.DONE)
"""States in which the server's list may lack the goal."""


class CommStateMachine:
    """Follows the server's reports about a goal."""

    def __init__(
        self,
        action_goal: Any,
        transition_cb: Callable[..., object] | None,
        feedback_cb: Callable[..., object] | None,
        send_goal_fn: Callable[[Any], object],
        send_cancel_fn: Callable[[Any], object],
    ) -> None:
        self.action_goal = action_goal
        self.transition_cb = transition_cb
        self.feedback_cb = feedback_cb
        self.send_goal_fn = send_goal_fn
        self.send_cancel_fn = send_cancel_fn
        self.state = CommState.WAITING_FOR_GOAL_ACK
        self.mutex = threading.RLock()
        self.latest_goal_status = GoalStatus(status=GoalStatus.PENDING)
        self.latest_result: Any = None

    def __eq__(self, o: Any) -> bool:
        return self.action_goal.goal_id.id == o.action_goal.goal_id.id

    def __hash__(self) -> int:
        return hash(self.action_goal.goal_id.id)

    def set_state(self, state: int) -> None:
        """Set the state without a callback."""
        self.state = state

    def update_status(self, status_array: Any) -> None:
        """Process a GoalStatusArray."""
        with self.mutex:
            if self.state == CommState.DONE:
                return
            goal_id = self.action_goal.goal_id.id
            status = next((entry for entry in status_array.status_list if entry.goal_id.id == goal_id), None)
            if status is None:
                if self.state not in _UNLISTED:
                    self.latest_goal_status.status = GoalStatus.LOST
                    self.transition_to(CommState.DONE)
                return
            self.latest_goal_status = status
            self._follow(status.status)

    def _follow(self, status: int) -> None:
        try:
            states = next_states(self.state, status)
        except KeyError:
            rospy.logerr(f"action goal {self.action_goal.goal_id.id}: unknown status {status} from the server")
            return
        if states is None:
            rospy.logerr(
                f"action goal {self.action_goal.goal_id.id}: the server went from "
                f"{CommState.to_string(self.state)} to {GoalStatus.to_string(status)}, which is not allowed"
            )
            return
        for state in states:
            self.transition_to(state)

    def transition_to(self, state: int) -> None:
        """Enter a state and call the transition callback."""
        self.state = state
        if self.transition_cb:
            self.transition_cb(ClientGoalHandle(self))

    def update_result(self, action_result: Any) -> None:
        """Process a result, if it is this goal's."""
        if self.action_goal.goal_id.id != action_result.status.goal_id.id:
            return
        with self.mutex:
            if self.state == CommState.DONE:
                rospy.logerr(f"action goal {self.action_goal.goal_id.id}: duplicate result")
                return
            self.latest_goal_status = action_result.status
            self.latest_result = action_result
            self.update_status(GoalStatusArray(status_list=[action_result.status]))
            self.transition_to(CommState.DONE)

    def update_feedback(self, action_feedback: Any) -> None:
        """Pass feedback on, if it is this goal's."""
        if self.action_goal.goal_id.id != action_feedback.status.goal_id.id:
            return
        if self.feedback_cb and self.state != CommState.DONE:
            self.feedback_cb(ClientGoalHandle(self), action_feedback.feedback)
