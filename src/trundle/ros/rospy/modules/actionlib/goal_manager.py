"""All goals of one client."""

import itertools
import threading
import weakref
from collections.abc import Callable
from typing import Any

from actionlib_msgs.msg import GoalID
from std_msgs.msg import Header

import rospy

from .action_types import ActionTypes
from .client_goal_handle import ClientGoalHandle
from .comm_state_machine import CommStateMachine

_counter = itertools.count(1)


class GoalManager(ActionTypes):
    """Goals whose handles are still in use."""

    def __init__(self, ActionSpec: type) -> None:
        super().__init__(ActionSpec)
        self.list_mutex = threading.RLock()
        self.statuses: list[weakref.ref[CommStateMachine]] = []
        self.send_goal_fn: Any = None
        self.cancel_fn: Any = None

    def register_send_goal_fn(self, fn: Callable[..., object]) -> None:
        """Set the function that publishes goals."""
        self.send_goal_fn = fn

    def register_cancel_fn(self, fn: Callable[..., object]) -> None:
        """Set the function that publishes cancel requests."""
        self.cancel_fn = fn

    def init_goal(
        self,
        goal: Any,
        transition_cb: Callable[..., object] | None = None,
        feedback_cb: Callable[..., object] | None = None,
    ) -> ClientGoalHandle:
        """Send a goal; returns its ClientGoalHandle."""
        now = rospy.Time.now()
        goal_id = GoalID(id=f"{rospy.get_caller_id()}-{next(_counter)}-{now.to_sec():.3f}", stamp=now)
        action_goal = self.ActionGoal(header=Header(stamp=now), goal_id=goal_id, goal=goal)
        machine = CommStateMachine(action_goal, transition_cb, feedback_cb, self.send_goal_fn, self.cancel_fn)
        with self.list_mutex:
            self.statuses.append(weakref.ref(machine))
        self.send_goal_fn(action_goal)
        return ClientGoalHandle(machine)

    def update_statuses(self, status_array: Any) -> None:
        """Pass a GoalStatusArray on to all goals."""
        for machine in self._live():
            machine.update_status(status_array)

    def update_results(self, action_result: Any) -> None:
        """Pass a result on."""
        for machine in self._live():
            machine.update_result(action_result)

    def update_feedbacks(self, action_feedback: Any) -> None:
        """Pass feedback on."""
        for machine in self._live():
            machine.update_feedback(action_feedback)

    def _live(self) -> list[CommStateMachine]:
        with self.list_mutex:
            machines = [(reference, reference()) for reference in self.statuses]
            self.statuses = [reference for reference, machine in machines if machine is not None]
        return [machine for _, machine in machines if machine is not None]
