"""State that sends a goal to an action."""

import copy
import threading
import traceback
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from typing import Any

from actionlib_msgs.msg import GoalStatus

import genpy
import rospy
import smach
from actionlib import SimpleActionClient

from .callbacks import StateCallback

_MINUTE = rospy.Duration(60.0)
_POLL_S = 0.1


class SimpleActionState(smach.State):
    """One goal; outcomes succeeded, aborted, preempted, and those of the result callback."""

    WAITING_FOR_SERVER = 0
    INACTIVE = 1
    ACTIVE = 2
    PREEMPTING = 3
    COMPLETED = 4

    def __init__(
        self,
        action_name: str,
        action_spec: type,
        goal: Any = None,
        goal_key: str | None = None,
        goal_slots: Sequence[str] = (),
        goal_cb: Callable[..., Any] | None = None,
        goal_cb_args: Iterable[Any] = (),
        goal_cb_kwargs: Mapping[str, Any] | None = None,
        result_key: str | None = None,
        result_slots: Sequence[str] = (),
        result_cb: Callable[..., Any] | None = None,
        result_cb_args: Iterable[Any] = (),
        result_cb_kwargs: Mapping[str, Any] | None = None,
        input_keys: Collection[str] = (),
        output_keys: Collection[str] = (),
        outcomes: Iterable[str] = (),
        exec_timeout: genpy.Duration | None = None,
        preempt_timeout: genpy.Duration = _MINUTE,
        server_wait_timeout: genpy.Duration = _MINUTE,
    ) -> None:
        """Set the action.

        Args:
            action_name: action's name.
            action_spec: XAction class.
            goal: XGoal; default: an empty one.
            goal_key: goal's key in the userdata.
            goal_slots: fields of the goal that are copied from keys of the same name.
            goal_cb: called with (userdata, goal); changes the goal or returns one.
            goal_cb_args: more arguments for goal_cb.
            goal_cb_kwargs: more named arguments for goal_cb.
            result_key: key that the result is written to.
            result_slots: fields of the result that are written to keys of the same name.
            result_cb: called with (userdata, GoalStatus number, result); may return an outcome.
            result_cb_args: more arguments for result_cb.
            result_cb_kwargs: more named arguments for result_cb.
            input_keys: keys that the callbacks read.
            output_keys: keys that the callbacks write.
            outcomes: outcomes that result_cb may return.
            exec_timeout: rospy.Duration after which the goal is canceled.
            preempt_timeout: no effect.
            server_wait_timeout: rospy.Duration to wait for the server.

        Raises:
            smach.InvalidStateError: a slot does not exist, or a callback is not callable.
        """
        super().__init__(outcomes=["succeeded", "aborted", "preempted"])
        action = action_spec()
        if callable(goal):
            raise smach.InvalidStateError("the goal of a SimpleActionState is a function; pass it as goal_cb")
        _check_slots("goal", goal_slots, action.action_goal.goal)
        _check_slots("result", result_slots, action.action_result.result)
        self._action_name, self._action_spec = action_name, action_spec
        self._goal = copy.copy(action.action_goal.goal) if goal is None else goal
        self._goal_key, self._goal_slots = goal_key, goal_slots
        self._result_key, self._result_slots = result_key, result_slots
        self._exec_timeout, self._preempt_timeout = exec_timeout, preempt_timeout
        self._server_wait_timeout = server_wait_timeout
        self._goal_status = 0
        self._goal_result: Any = None
        self._goal_cb = StateCallback(
            self, goal_cb, goal_cb_args, goal_cb_kwargs, input_keys, output_keys, declares_outcomes=False
        )
        self._result_cb = StateCallback(
            self, result_cb, result_cb_args, result_cb_kwargs, input_keys, output_keys, declares_outcomes=True
        )
        self.register_input_keys([*goal_slots, *([goal_key] if goal_key is not None else [])])
        self.register_output_keys([*result_slots, *([result_key] if result_key is not None else [])])
        self.register_outcomes(outcomes)
        self._status = SimpleActionState.WAITING_FOR_SERVER
        self._action_client = SimpleActionClient(action_name, action_spec)
        self._done = threading.Event()

    def request_preempt(self) -> None:
        """Cancel the goal, if it is active."""
        super().request_preempt()
        if self._status == SimpleActionState.ACTIVE:
            self._action_client.cancel_goal()

    def execute(self, ud: Any) -> str:
        """Send the goal and wait for its end."""
        self._wait_for_server()
        if self.preempt_requested():
            self.service_preempt()
            return "preempted"
        if self._status == SimpleActionState.WAITING_FOR_SERVER:
            rospy.logfatal(f"Action server for {self._action_name} is not running.")
            return "aborted"
        if not self._fill(ud):
            return "aborted"
        self._run()
        outcome = self._outcome()
        if self._result_cb.function is not None:
            try:
                outcome = self._result_cb(ud, self._goal_status, self._goal_result) or outcome
            except Exception:
                rospy.logerr(f"Could not execute result callback: {traceback.format_exc()}")
                return "aborted"
            if outcome not in self.get_registered_outcomes():
                rospy.logerr(
                    f"the result callback of action {self._action_name} returned '{outcome}', which is not declared; "
                    f"outcomes are {self.get_registered_outcomes()}"
                )
                return "aborted"
        if self._result_key is not None:
            ud[self._result_key] = self._goal_result
        if self._goal_result is not None:
            for key in self._result_slots:
                ud[key] = getattr(self._goal_result, key)
        return outcome

    def _wait_for_server(self) -> None:
        end = rospy.get_rostime() + self._server_wait_timeout
        while self._status == SimpleActionState.WAITING_FOR_SERVER and not rospy.is_shutdown():
            if self._action_client.wait_for_server(rospy.Duration(_POLL_S)):
                self._status = SimpleActionState.INACTIVE
            elif self.preempt_requested() or rospy.get_rostime() >= end:
                return

    def _fill(self, ud: Any) -> bool:
        """Fill the goal from the userdata; False if that fails."""
        if self._goal_key is not None:
            goal = ud[self._goal_key]
            self._goal = getattr(goal, "_obj", goal)
        for key in self._goal_slots:
            value = ud[key]
            setattr(self._goal, key, getattr(value, "_obj", value))
        if self._goal_cb.function is not None:
            try:
                self._goal = self._goal_cb(ud, self._goal) or self._goal
            except Exception:
                rospy.logerr(f"Could not execute goal callback: {traceback.format_exc()}")
                return False
        return True

    def _run(self) -> None:
        """Send the goal and wait; cancel it after the timeout."""
        start = rospy.Time.now()
        is_canceled = False
        self._done.clear()
        self._status = SimpleActionState.ACTIVE
        self._action_client.send_goal(self._goal, self._goal_done_cb)
        while not self._done.wait(_POLL_S) and not rospy.is_shutdown():
            if self._exec_timeout and not is_canceled and rospy.Time.now() - start > self._exec_timeout:
                rospy.logwarn(f"Action {self._action_name} timed out after {self._exec_timeout.to_sec():g} seconds.")
                self._action_client.cancel_goal()
                is_canceled = True

    def _outcome(self) -> str:
        if self._status != SimpleActionState.INACTIVE:  # the node shut down before the goal's end
            return "aborted"
        if self._goal_status == GoalStatus.SUCCEEDED:
            return "succeeded"
        if self._goal_status == GoalStatus.PREEMPTED and self.preempt_requested():
            self.service_preempt()
            return "preempted"
        return "aborted"

    def _goal_done_cb(self, result_state: int, result: Any) -> None:
        self._goal_status, self._goal_result = result_state, result
        self._status = SimpleActionState.INACTIVE
        self._done.set()


def _check_slots(kind: str, slots: Iterable[str], message: Any) -> None:
    unknown = [slot for slot in slots if slot not in message.__slots__]
    if unknown:
        raise smach.InvalidStateError(f"the {kind} has no {', '.join(unknown)}; its fields are {message.__slots__}")
