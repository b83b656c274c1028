"""State of one goal at its client."""

import threading

from actionlib_msgs.msg import GoalStatus, GoalStatusArray

import rospy

from .client_goal_handle import ClientGoalHandle
from .comm_state import CommState, next_states

_UNLISTED = (CommState.WAITING_FOR_GOAL_ACK, CommState.WAITING_FOR_RESULT, CommState.DONE)
"""States in which the server need not list the goal."""


class CommStateMachine:
    """Follows what the server says about a goal."""

    def __init__(self, action_goal, transition_cb, feedback_cb, send_goal_fn, send_cancel_fn):
        self.action_goal = action_goal
        self.transition_cb = transition_cb
        self.feedback_cb = feedback_cb
        self.send_goal_fn = send_goal_fn
        self.send_cancel_fn = send_cancel_fn
        self.state = CommState.WAITING_FOR_GOAL_ACK
        self.mutex = threading.RLock()
        self.latest_goal_status = GoalStatus(status=GoalStatus.PENDING)
        self.latest_result = None

    def __eq__(self, o):
        return self.action_goal.goal_id.id == o.action_goal.goal_id.id

    def __hash__(self):
        return hash(self.action_goal.goal_id.id)

    def set_state(self, state):
        """Set the state without calling anyone."""
        self.state = state

    def update_status(self, status_array):
        """Take note of a GoalStatusArray."""
        with self.mutex:
            if self.state == CommState.DONE:
                return
            goal_id = self.action_goal.goal_id.id
            status = next((each for each in status_array.status_list if each.goal_id.id == goal_id), None)
            if status is None:
                if self.state not in _UNLISTED:
                    self.latest_goal_status.status = GoalStatus.LOST
                    self.transition_to(CommState.DONE)
                return
            self.latest_goal_status = status
            self._follow(status.status)

    def _follow(self, status):
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

    def transition_to(self, state):
        """Enter a state and call the user."""
        self.state = state
        if self.transition_cb:
            self.transition_cb(ClientGoalHandle(self))

    def update_result(self, action_result):
        """Take note of a result, if it is this goal's."""
        if self.action_goal.goal_id.id != action_result.status.goal_id.id:
            return
        with self.mutex:
            if self.state == CommState.DONE:
                rospy.logerr(f"action goal {self.action_goal.goal_id.id}: a second result")
                return
            self.latest_goal_status = action_result.status
            self.latest_result = action_result
            self.update_status(GoalStatusArray(status_list=[action_result.status]))
            self.transition_to(CommState.DONE)

    def update_feedback(self, action_feedback):
        """Pass feedback on, if it is this goal's."""
        if self.action_goal.goal_id.id != action_feedback.status.goal_id.id:
            return
        if self.feedback_cb and self.state != CommState.DONE:
            self.feedback_cb(ClientGoalHandle(self), action_feedback.feedback)
