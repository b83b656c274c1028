"""State that calls a service."""

import traceback

import rospy
import smach

from .callbacks import StateCallback


class ServiceState(smach.State):
    """One call; outcomes succeeded, aborted, preempted, and those of the response callback."""

    def __init__(
        self,
        service_name,
        service_spec,
        request=None,
        request_cb=None,
        request_cb_args=(),
        request_cb_kwargs=None,
        request_key=None,
        request_slots=(),
        response_cb=None,
        response_cb_args=(),
        response_cb_kwargs=None,
        response_key=None,
        response_slots=(),
        input_keys=(),
        output_keys=(),
        outcomes=(),
    ):
        """Set the service.

        Args:
            service_name: its name.
            service_spec: its class.
            request: the request; default: an empty one.
            request_cb: called with (userdata, request); changes the request or returns one.
            request_cb_args: more arguments for it.
            request_cb_kwargs: more named arguments for it.
            request_key: key of the request in the userdata.
            request_slots: fields of the request that are taken from keys of the same name.
            response_cb: called with (userdata, response); may return an outcome.
            response_cb_args: more arguments for it.
            response_cb_kwargs: more named arguments for it.
            response_key: key that the response is written to.
            response_slots: fields of the response that are written to keys of the same name.
            input_keys: keys that the callbacks read.
            output_keys: keys that they write.
            outcomes: outcomes that response_cb may return.
        """
        super().__init__(outcomes=["succeeded", "aborted", "preempted"])
        self._service_name = service_name
        self._service_spec = service_spec
        self._proxy = None
        self._request = service_spec._request_class() if request is None else request
        self._request_cb = StateCallback(
            self, request_cb, request_cb_args, request_cb_kwargs, input_keys, output_keys, declares_outcomes=False
        )
        self._response_cb = StateCallback(
            self, response_cb, response_cb_args, response_cb_kwargs, input_keys, output_keys, declares_outcomes=True
        )
        self._request_key, self._request_slots = request_key, request_slots
        self._response_key, self._response_slots = response_key, response_slots
        self.register_input_keys([*request_slots, *([request_key] if request_key is not None else [])])
        self.register_output_keys([*response_slots, *([response_key] if response_key is not None else [])])
        self.register_outcomes(outcomes)

    def execute(self, ud):
        """Call."""
        if self.preempt_requested():
            self.service_preempt()
            return "preempted"
        ended = self._connect() or self._fill(ud)
        if ended:
            return ended
        try:
            response = self._proxy(self._request)
        except rospy.ServiceException as error:
            rospy.logerr(f"Exception when calling service '{self._service_name}': {error}")
            return "aborted"
        outcome = "succeeded"
        if self._response_cb.function is not None:
            try:
                outcome = self._response_cb(ud, response) or outcome
            except Exception:
                rospy.logerr(f"Could not execute response callback: {traceback.format_exc()}")
                return "aborted"
            if outcome not in self.get_registered_outcomes():
                rospy.logerr(
                    f"the response callback of service {self._service_name} returned '{outcome}', which is not "
                    f"declared; outcomes are {self.get_registered_outcomes()}"
                )
                return "aborted"
        if self._response_key is not None:
            ud[self._response_key] = response
        for key in self._response_slots:
            ud[key] = getattr(response, key)
        return outcome

    def _connect(self):
        """Wait for the service; returns an outcome if that is over before."""
        while self._proxy is None:
            if self.preempt_requested():
                self.service_preempt()
                return "preempted"
            if rospy.is_shutdown():
                return "aborted"
            try:
                rospy.wait_for_service(self._service_name, 1.0)
                self._proxy = rospy.ServiceProxy(self._service_name, self._service_spec)
            except rospy.ROSInterruptException:
                return "aborted"
            except rospy.ROSException:
                rospy.logwarn(f"Still waiting for service '{self._service_name}'...")
        return None

    def _fill(self, ud):
        """Make the request of the userdata; returns an outcome if that fails."""
        for key in (self._request_key, *self._request_slots):
            if key is not None and key not in ud:
                rospy.logerr(f"the userdata has no '{key}' for service {self._service_name}; it has {ud.keys()}")
                return "aborted"
        if self._request_key is not None:
            self._request = ud[self._request_key]
            self._request = getattr(self._request, "_obj", self._request)
        for key in self._request_slots:
            value = ud[key]
            setattr(self._request, key, getattr(value, "_obj", value))
        if self._request_cb.function is not None:
            try:
                self._request = self._request_cb(ud, self._request) or self._request
            except Exception:
                rospy.logerr(f"Could not execute request callback: {traceback.format_exc()}")
                return "aborted"
        return None
