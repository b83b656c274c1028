"""State that calls a service."""

import traceback
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from typing import Any

import rospy
import smach

from .callbacks import StateCallback


class ServiceState(smach.State):
    """One call; outcomes succeeded, aborted, preempted, and those of the response callback."""

    def __init__(
        self,
        service_name: str,
        service_spec: Any,
        request: Any = None,
        request_cb: Callable[..., Any] | None = None,
        request_cb_args: Iterable[Any] = (),
        request_cb_kwargs: Mapping[str, Any] | None = None,
        request_key: str | None = None,
        request_slots: Sequence[str] = (),
        response_cb: Callable[..., Any] | None = None,
        response_cb_args: Iterable[Any] = (),
        response_cb_kwargs: Mapping[str, Any] | None = None,
        response_key: str | None = None,
        response_slots: Sequence[str] = (),
        input_keys: Collection[str] = (),
        output_keys: Collection[str] = (),
        outcomes: Iterable[str] = (),
    ) -> None:
        """Set the service.

        Args:
            service_name: service's name.
            service_spec: service's class.
            request: request; default: an empty one.
            request_cb: called with (userdata, request); changes the request or returns one.
            request_cb_args: more arguments for request_cb.
            request_cb_kwargs: more named arguments for request_cb.
            request_key: request's key in the userdata.
            request_slots: fields of the request that are copied from keys of the same name.
            response_cb: called with (userdata, response); may return an outcome.
            response_cb_args: more arguments for response_cb.
            response_cb_kwargs: more named arguments for response_cb.
            response_key: key that the response is written to.
            response_slots: fields of the response that are written to keys of the same name.
            input_keys: keys that the callbacks read.
            output_keys: keys that the callbacks write.
            outcomes: outcomes that response_cb may return.
        """
        super().__init__(outcomes=["succeeded", "aborted", "preempted"])
        self._service_name = service_name
        self._service_spec = service_spec
        self._proxy: Any = None
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

    def execute(self, ud: Any) -> str:
        """Call the service."""
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

    def _connect(self) -> str | None:
        """Wait for the service; returns an outcome if the state ends before."""
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

    def _fill(self, ud: Any) -> str | None:
        """Fill the request from the userdata; returns an outcome if that fails."""
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
