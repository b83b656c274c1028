"""State that watches a topic."""

import threading

import rospy
import smach


class MonitorState(smach.State):
    """Asks a function about each message; outcomes valid, invalid, preempted."""

    def __init__(self, topic, msg_type, cond_cb, max_checks=-1, input_keys=(), output_keys=()):
        """Set the topic.

        Args:
            topic: its name.
            msg_type: its message class.
            cond_cb: called with (userdata, message); False ends with invalid.
            max_checks: number of True that ends with valid, -1: no limit.
            input_keys: keys that it reads.
            output_keys: keys that it writes.
        """
        super().__init__(outcomes=["valid", "invalid", "preempted"], input_keys=input_keys, output_keys=output_keys)
        self._topic = topic
        self._msg_type = msg_type
        self._cond_cb = cond_cb
        self._max_checks = max_checks
        self._n_checks = 0
        self._trigger_event = threading.Event()

    def execute(self, ud):
        """Watch."""
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

    def _cb(self, msg, ud):
        if self._trigger_event.is_set():
            return
        try:
            is_good = self._cond_cb(ud, msg)
        except Exception as error:
            rospy.logerr(f"Error thrown while executing condition callback {self._cond_cb}: {error}")
            is_good = False
        self._n_checks += bool(is_good)
        if not is_good or 0 < self._max_checks <= self._n_checks:
            self._trigger_event.set()

    def request_preempt(self):
        """End soon."""
        super().request_preempt()
        self._trigger_event.set()
