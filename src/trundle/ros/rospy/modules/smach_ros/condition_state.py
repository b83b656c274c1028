"""State that waits for a condition."""

import traceback
from collections.abc import Callable, Iterable
from typing import Any

import genpy
import rospy
import smach

_POLL = rospy.Duration(0.05)


class ConditionState(smach.State):
    """Calls a function until it returns True; outcomes true, false, preempted."""

    def __init__(
        self,
        cond_cb: Callable[[Any], Any],
        input_keys: Iterable[str] = (),
        poll_rate: genpy.Duration = _POLL,
        timeout: genpy.Duration | None = None,
        max_checks: int = 1,
    ) -> None:
        """Set the condition.

        Args:
            cond_cb: called with the userdata.
            input_keys: keys that cond_cb reads.
            poll_rate: rospy.Duration between two calls.
            timeout: rospy.Duration after which the outcome is false.
            max_checks: calls after which the outcome is false; -1: no limit.
        """
        super().__init__(outcomes=["true", "false", "preempted"], input_keys=input_keys)
        self._cond_cb = cond_cb
        interface: Any = cond_cb
        if hasattr(interface, "get_registered_input_keys") and hasattr(interface, "get_registered_output_keys"):
            self.register_input_keys(interface.get_registered_input_keys())
            self.register_output_keys(interface.get_registered_output_keys())
        self._poll_rate = poll_rate
        self._timeout = timeout
        self._max_checks = max_checks

    def execute(self, ud: Any) -> str:
        """Wait."""
        start = rospy.Time.now()
        checks = 0
        while self._max_checks == -1 or checks <= self._max_checks:
            if self._timeout and rospy.Time.now() - start > self._timeout:
                break
            if self.preempt_requested():
                self.service_preempt()
                return "preempted"
            try:
                if self._cond_cb(ud):
                    return "true"
            except Exception:
                raise smach.InvalidUserCodeError(
                    f"Error thrown while executing condition callback {self._cond_cb}: {traceback.format_exc()}"
                ) from None
            checks += 1
            rospy.sleep(self._poll_rate)
        return "false"
