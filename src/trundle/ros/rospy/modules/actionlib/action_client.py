"""Client of an action, with any number of goals."""

import time
from collections.abc import Callable
from typing import Any

from actionlib_msgs.msg import GoalID, GoalStatus, GoalStatusArray

import genpy
import rospy

from .action_types import ActionTypes
from .client_goal_handle import ClientGoalHandle
from .comm_state import CommState, TerminalState, get_name_of_constant
from .exceptions import ActionException
from .goal_manager import GoalManager

__all__ = [
    "ActionClient",
    "ActionException",
    "ClientGoalHandle",
    "CommState",
    "GoalManager",
    "GoalStatus",
    "TerminalState",
    "get_name_of_constant",
]

_FOREVER = rospy.Duration(0.0)


class ActionClient(ActionTypes):
    """Sends goals to an action server."""

    def __init__(self, ns: str, ActionSpec: type) -> None:
        """Connect to the action `ns`.

        Args:
            ns: action's name.
            ActionSpec: XAction class.

        Raises:
            ActionException: the class is not an action.
        """
        super().__init__(ActionSpec)
        self.ns = ns
        self.last_status_msg: Any = None
        name = rospy.remap_name(ns)
        pub_queue = rospy.get_param("actionlib_client_pub_queue_size", 10)
        self.pub_queue_size = pub_queue if pub_queue >= 0 else 10
        self.pub_goal = rospy.Publisher(f"{name}/goal", self.ActionGoal, queue_size=self.pub_queue_size)
        self.pub_cancel = rospy.Publisher(f"{name}/cancel", GoalID, queue_size=self.pub_queue_size)
        self.manager = GoalManager(ActionSpec)
        self.manager.register_send_goal_fn(self.pub_goal.publish)
        self.manager.register_cancel_fn(self.pub_cancel.publish)
        sub_queue = rospy.get_param("actionlib_client_sub_queue_size", -1)
        self.sub_queue_size = sub_queue if sub_queue >= 0 else None
        options: dict[str, Any] = {"queue_size": self.sub_queue_size}
        self.status_sub = rospy.Subscriber(f"{name}/status", GoalStatusArray, callback=self._status_cb, **options)
        self.result_sub = rospy.Subscriber(
            f"{name}/result", self.ActionResult, callback=self.manager.update_results, **options
        )
        self.feedback_sub = rospy.Subscriber(
            f"{name}/feedback", self.ActionFeedback, callback=self.manager.update_feedbacks, **options
        )

    def stop(self) -> None:
        """Unregister from the action's topics."""
        for endpoint in (self.pub_goal, self.pub_cancel, self.status_sub, self.result_sub, self.feedback_sub):
            endpoint.unregister()

    def send_goal(
        self,
        goal: Any,
        transition_cb: Callable[..., object] | None = None,
        feedback_cb: Callable[..., object] | None = None,
    ) -> ClientGoalHandle:
        """Send a goal; returns its ClientGoalHandle.

        Args:
            goal: an XGoal.
            transition_cb: called with the handle at each change of state.
            feedback_cb: called with the handle and an XFeedback.
        """
        return self.manager.init_goal(goal, transition_cb, feedback_cb)

    def cancel_all_goals(self) -> None:
        """Ask the server to cancel every goal, of all clients."""
        self.pub_cancel.publish(GoalID(stamp=rospy.Time(0), id=""))

    def cancel_goals_at_and_before_time(self, time: genpy.Time) -> None:
        """Ask the server to cancel every goal that is not newer than a rospy.Time."""
        self.pub_cancel.publish(GoalID(stamp=time, id=""))

    def wait_for_action_server_to_start(self, timeout: genpy.Duration = _FOREVER) -> bool:
        """Old name of `wait_for_server`."""
        return self.wait_for_server(timeout)

    def wait_for_server(self, timeout: genpy.Duration = _FOREVER) -> bool:
        """Wait until the server is connected; False if that takes longer than the timeout (0: no limit)."""
        end = rospy.get_rostime() + timeout
        while not rospy.is_shutdown():
            if self._is_connected():
                return True
            if timeout != _FOREVER and rospy.get_rostime() >= end:
                return False
            time.sleep(0.01)
        return False

    def _is_connected(self) -> bool:
        endpoints = (self.pub_goal, self.pub_cancel, self.result_sub, self.feedback_sub)
        return self.last_status_msg is not None and all(endpoint.get_num_connections() for endpoint in endpoints)

    def _status_cb(self, msg: Any) -> None:
        self.last_status_msg = msg
        self.manager.update_statuses(msg)
