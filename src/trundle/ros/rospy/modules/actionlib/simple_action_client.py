"""Client of an action, with one goal at a time."""

import threading
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from actionlib_msgs.msg import GoalStatus

import genpy
import rospy

from .action_client import ActionClient
from .comm_state import CommState, get_name_of_constant

if TYPE_CHECKING:
    from .client_goal_handle import ClientGoalHandle

_FOREVER = rospy.Duration()
_POLL = rospy.Duration(0.1)


class SimpleGoalState:
    """State of the goal, simplified."""

    PENDING = 0
    ACTIVE = 1
    DONE = 2
    to_string = classmethod(get_name_of_constant)


class SimpleActionClient:
    """Sends one goal at a time, and forgets the previous one."""

    def __init__(self, ns: str, ActionSpec: type) -> None:
        """Connect to the action `ns`, of the class XAction."""
        self.action_client = ActionClient(ns, ActionSpec)
        self.simple_state = SimpleGoalState.DONE
        self.gh: ClientGoalHandle | None = None
        self.done_condition = threading.Condition()
        self.done_cb: Callable[..., object] | None = None
        self.active_cb: Callable[..., object] | None = None
        self.feedback_cb: Callable[..., object] | None = None
        self._is_sending = False
        """True while a goal is being sent: its first transition may come before its handle is stored."""

    def wait_for_server(self, timeout: genpy.Duration = _FOREVER) -> bool:
        """Wait until the server is connected; False if that takes longer than the timeout (0: no limit)."""
        return self.action_client.wait_for_server(timeout)

    def send_goal(
        self,
        goal: Any,
        done_cb: Callable[..., object] | None = None,
        active_cb: Callable[..., object] | None = None,
        feedback_cb: Callable[..., object] | None = None,
    ) -> None:
        """Send a goal; an earlier one continues, but is no longer tracked.

        Args:
            goal: an XGoal.
            done_cb: called with the final GoalStatus number and the XResult.
            active_cb: called when the goal starts.
            feedback_cb: called with each XFeedback.
        """
        self.stop_tracking_goal()
        self.done_cb = done_cb
        self.active_cb = active_cb
        self.feedback_cb = feedback_cb
        self.simple_state = SimpleGoalState.PENDING
        self._is_sending = True
        self.gh = self.action_client.send_goal(goal, self._handle_transition, self._handle_feedback)
        self._is_sending = False

    def send_goal_and_wait(
        self, goal: Any, execute_timeout: genpy.Duration = _FOREVER, preempt_timeout: genpy.Duration = _FOREVER
    ) -> int:
        """Send a goal, wait for its end, and cancel it after a timeout; returns the GoalStatus number.

        Args:
            goal: an XGoal.
            execute_timeout: rospy.Duration until the goal is canceled; 0: never.
            preempt_timeout: rospy.Duration to wait after the cancel request; 0: no limit.
        """
        self.send_goal(goal)
        if not self.wait_for_result(execute_timeout):
            self.cancel_goal()
            self.wait_for_result(preempt_timeout)
        return self.get_state()

    def wait_for_result(self, timeout: genpy.Duration = _FOREVER) -> bool:
        """Wait until the goal is done; False if that takes longer than the timeout (0: no limit)."""
        if not self.gh:
            rospy.logerr("wait_for_result without a goal; call send_goal first")
            return False
        end = rospy.get_rostime() + timeout
        with self.done_condition:
            while not rospy.is_shutdown() and self.simple_state != SimpleGoalState.DONE:
                left = end - rospy.get_rostime()
                if timeout > _FOREVER and left <= _FOREVER:
                    break
                self.done_condition.wait((_POLL if timeout == _FOREVER else min(left, _POLL)).to_sec())
        return self.simple_state == SimpleGoalState.DONE

    def get_result(self) -> Any:
        """The XResult, or None if there is none yet."""
        if not self.gh:
            rospy.logerr("get_result without a goal; call send_goal first")
            return None
        return self.gh.get_result()

    def get_state(self) -> int:
        """GoalStatus number of the goal, LOST if there is none; RECALLING counts as PENDING, PREEMPTING as ACTIVE."""
        if not self.gh:
            return GoalStatus.LOST
        status = self.gh.get_goal_status()
        return {GoalStatus.RECALLING: GoalStatus.PENDING, GoalStatus.PREEMPTING: GoalStatus.ACTIVE}.get(status, status)

    def get_goal_status_text(self) -> str:
        """Latest status text of the server."""
        if not self.gh:
            rospy.logerr("get_goal_status_text without a goal; call send_goal first")
            return "ERROR: Called get_goal_status_text when no goal is running"
        return self.gh.get_goal_status_text()

    def cancel_all_goals(self) -> None:
        """Ask the server to cancel every goal, of all clients."""
        self.action_client.cancel_all_goals()

    def cancel_goals_at_and_before_time(self, time: genpy.Time) -> None:
        """Ask the server to cancel every goal that is not newer than a rospy.Time."""
        self.action_client.cancel_goals_at_and_before_time(time)

    def cancel_goal(self) -> None:
        """Ask the server to cancel the goal."""
        if self.gh:
            self.gh.cancel()

    def stop_tracking_goal(self) -> None:
        """Forget the goal, without canceling it."""
        self.gh = None

    def _handle_transition(self, gh: "ClientGoalHandle") -> None:
        is_first = self.gh is None and self._is_sending
        if gh != self.gh and not is_first:
            rospy.logerr("an action goal that is no longer tracked changed its state")
            return
        state = gh.get_comm_state()
        if state in (CommState.ACTIVE, CommState.PREEMPTING) and self.simple_state == SimpleGoalState.PENDING:
            self.simple_state = SimpleGoalState.ACTIVE
            if self.active_cb:
                self.active_cb()
        elif state == CommState.DONE and self.simple_state != SimpleGoalState.DONE:
            if self.done_cb:
                self.done_cb(gh.get_goal_status(), gh.get_result())
            with self.done_condition:
                self.simple_state = SimpleGoalState.DONE
                self.done_condition.notify_all()

    def _handle_feedback(self, gh: "ClientGoalHandle", feedback: Any) -> None:
        if self.gh and gh == self.gh and self.feedback_cb:
            self.feedback_cb(feedback)
