"""Server's handle of a goal."""

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from actionlib_msgs.msg import GoalID, GoalStatus

import rospy

if TYPE_CHECKING:
    from .handle_tracker_deleter import HandleTrackerDeleter
    from .status_tracker import StatusTracker

_WAITING = (GoalStatus.PENDING, GoalStatus.RECALLING)
_RUNNING = (GoalStatus.ACTIVE, GoalStatus.PREEMPTING)


class ServerGoalHandle:
    """Accepts, ends and reports on one goal."""

    def __init__(
        self,
        status_tracker: "StatusTracker | None" = None,
        action_server: Any = None,
        handle_tracker: "HandleTrackerDeleter | None" = None,
    ) -> None:
        self.status_tracker: Any = status_tracker
        self.action_server: Any = action_server
        self.handle_tracker = handle_tracker
        self.goal = status_tracker.goal if status_tracker else None

    def get_default_result(self) -> Any:
        """An empty XResult."""
        return self.action_server.ActionResultType()

    def set_accepted(self, text: str = "") -> None:
        """Start the goal: ACTIVE, or PREEMPTING if it was canceled before."""
        if not self._has_goal("set_accepted"):
            return
        with self.action_server.lock:
            status = self.status_tracker.status
            if status.status not in _WAITING:
                self._log_refusal("accepted", _WAITING)
                return
            status.status = GoalStatus.ACTIVE if status.status == GoalStatus.PENDING else GoalStatus.PREEMPTING
            status.text = text
            self.action_server.publish_status()

    def set_canceled(self, result: Any = None, text: str = "") -> None:
        """End the goal: RECALLED if it was not started, else PREEMPTED."""
        ends = dict.fromkeys(_WAITING, GoalStatus.RECALLED) | dict.fromkeys(_RUNNING, GoalStatus.PREEMPTED)
        self._end("canceled", ends, result, text)

    def set_rejected(self, result: Any = None, text: str = "") -> None:
        """Reject a goal that was not started."""
        self._end("rejected", dict.fromkeys(_WAITING, GoalStatus.REJECTED), result, text)

    def set_aborted(self, result: Any = None, text: str = "") -> None:
        """End a started goal as failed."""
        self._end("aborted", dict.fromkeys(_RUNNING, GoalStatus.ABORTED), result, text)

    def set_succeeded(self, result: Any = None, text: str = "") -> None:
        """End a started goal as reached."""
        self._end("succeeded", dict.fromkeys(_RUNNING, GoalStatus.SUCCEEDED), result, text)

    def publish_feedback(self, feedback: Any) -> None:
        """Send an XFeedback to the goal's clients."""
        if self._has_goal("publish_feedback"):
            with self.action_server.lock:
                self.action_server.publish_feedback(self.status_tracker.status, feedback)

    def get_goal(self) -> Any:
        """The XGoal, or None if the handle is empty."""
        return self.goal.goal if self.goal else None

    def get_goal_id(self) -> Any:
        """The GoalID."""
        return self.get_goal_status().goal_id if self._has_goal("get_goal_id") else GoalID()

    def get_goal_status(self) -> Any:
        """The GoalStatus."""
        if not self._has_goal("get_goal_status"):
            return GoalStatus()
        with self.action_server.lock:
            return self.status_tracker.status

    def set_cancel_requested(self) -> bool:
        """Apply a cancel request; True if the user's callback must be called."""
        if not self.goal:
            return False
        with self.action_server.lock:
            status = self.status_tracker.status
            if status.status not in (GoalStatus.PENDING, GoalStatus.ACTIVE):
                return False
            status.status = GoalStatus.RECALLING if status.status == GoalStatus.PENDING else GoalStatus.PREEMPTING
            self.action_server.publish_status()
            return True

    def __eq__(self, other: Any) -> bool:
        if not self.goal or not other.goal:
            return False
        return self.get_goal_id().id == other.get_goal_id().id

    def __ne__(self, other: object) -> bool:
        return not self == other

    def __hash__(self) -> int:
        return hash(self.get_goal_id().id)

    def _end(self, verb: str, ends: Mapping[int, Any], result: Any, text: str) -> None:
        """Set a final status and publish the result; `ends` maps each allowed status to the final one."""
        if not self._has_goal(f"set_{verb}"):
            return
        with self.action_server.lock:
            status = self.status_tracker.status
            if status.status not in ends:
                self._log_refusal(verb, ends)
                return
            status.status = ends[status.status]
            status.text = text
            self.status_tracker.handle_destruction_time = rospy.Time.now()
            self.action_server.publish_result(status, result or self.get_default_result())

    def _log_refusal(self, verb: str, allowed: Iterable[int]) -> None:
        names = " or ".join(GoalStatus.to_string(status) for status in allowed)
        status = self.status_tracker.status
        rospy.logerr(
            f"goal {status.goal_id.id} cannot be {verb}: it is {GoalStatus.to_string(status.status)}, not {names}"
        )

    def _has_goal(self, method: str) -> bool:
        if not self.goal:
            rospy.logerr(f"{method} of a ServerGoalHandle without a goal")
        return bool(self.goal)
