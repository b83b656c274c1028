"""State that monitors a topic."""

import threading
from collections.abc import Callable, Iterable
from typing import Any

import rospy
import smach


class MonitorState(smach.State):
    """Checks each message by a function; outcomes valid, invalid, preempted."""

    def __init__(
        self,
        topic: str,
        msg_type: Any,
        cond_cb: Callable[[Any, Any], Any],
        max_checks: int = -1,
        input_keys: Iterable[str] = (),
        output_keys: Iterable[str] = (),
    ) -> None:
        """Set the topic.

        Args:
            topic: topic's name.
            msg_type: class of its messages.
            cond_cb: called with (userdata, message); on False the outcome is invalid.
            max_checks: count of True results after which the outcome is valid; -1: no limit.
            input_keys: keys that cond_cb reads.
            output_keys: keys that cond_cb writes.
        """
        super().__init__(outcomes=["valid", "invalid", "preempted"], input_keys=input_keys, output_keys=output_keys)
        self._topic = topic
        self._msg_type = msg_type
        self._cond_cb = cond_cb
        self._max_checks = max_checks
        self._n_checks = 0
        self._trigger_event = threading.Event()

    def execute(self, ud: Any) -> str:
        """Monitor the topic."""
        if self.preempt_requested():
            self.service_preempt()
            return "preempted"
        self._n_checks = 0
        self._trigger_event.clear()
        subscriber = rospy.Subscriber(self._topic, self._msg_type, self._cb, callback_args=ud)
        while not self._trigger_event.wait(0.1) and not rospy.is_shutdown():
            pass
        subscriber.unregister()
        if self.preempt_requested():
            self.service_preempt()
            return "preempted"
        return "valid" if 0 < self._max_checks <= self._n_checks else "invalid"

    def _cb(self, msg: Any, ud: Any) -> None:
        if self._trigger_event.is_set():
            return
        try:
            is_valid = self._cond_cb(ud, msg)
        except Exception as error:
            rospy.logerr(f"Error thrown while executing condition callback {self._cond_cb}: {error}")
            is_valid = False
        self._n_checks += bool(is_valid)
        if not is_valid or 0 < self._max_checks <= self._n_checks:
            self._trigger_event.set()

    def request_preempt(self) -> None:
        """Request that the state end soon."""
        super().request_preempt()
        self._trigger_event.set()
