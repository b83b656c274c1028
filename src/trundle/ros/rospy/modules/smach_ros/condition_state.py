"""State that waits for a condition."""

import traceback

import rospy
import smach

_POLL = rospy.Duration(0.05)


class ConditionState(smach.State):
    """Asks a function until it says yes; outcomes true, false, preempted."""

    def __init__(self, cond_cb, input_keys=(), poll_rate=_POLL, timeout=None, max_checks=1):
        """Set the condition.

        Args:
            cond_cb: called with the userdata.
            input_keys: keys that it reads.
            poll_rate: rospy.Duration between two calls.
            timeout: rospy.Duration after which the outcome is false.
            max_checks: calls after which it is, -1: no limit.
        """
        super().__init__(outcomes=["true", "false", "preempted"], input_keys=input_keys)
        self._cond_cb = cond_cb
        if hasattr(cond_cb, "get_registered_input_keys") and hasattr(cond_cb, "get_registered_output_keys"):
            self.register_input_keys(cond_cb.get_registered_input_keys())
            self.register_output_keys(cond_cb.get_registered_output_keys())
        self._poll_rate = poll_rate
        self._timeout = timeout
        self._max_checks = max_checks

    def execute(self, ud):
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
