"""Client of a node that looks up transforms for others (buffer_server)."""

from typing import Any

from actionlib_msgs.msg import GoalStatus
from tf2_msgs.msg import LookupTransformAction, LookupTransformGoal, TF2Error

import actionlib
import genpy
import rospy
from tf2_py import (
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    TimeoutException,
    TransformException,
)

from .buffer_interface import BufferInterface

_NO_WAIT = rospy.Duration(0.0)
_PADDING = rospy.Duration(2.0)
_ERRORS = {
    TF2Error.LOOKUP_ERROR: LookupException,
    TF2Error.CONNECTIVITY_ERROR: ConnectivityException,
    TF2Error.EXTRAPOLATION_ERROR: ExtrapolationException,
    TF2Error.INVALID_ARGUMENT_ERROR: InvalidArgumentException,
    TF2Error.TIMEOUT_ERROR: TimeoutException,
}


class BufferClient(BufferInterface):
    """Transforms looked up by an action server."""

    def __init__(
        self, ns: str, check_frequency: float | None = None, timeout_padding: genpy.Duration = _PADDING
    ) -> None:
        """Connect to the action `ns`.

        Args:
            ns: action's name.
            check_frequency: no effect, as since ROS Kinetic.
            timeout_padding: rospy.Duration by which the result may be late.
        """
        BufferInterface.__init__(self)
        self.client = actionlib.SimpleActionClient(ns, LookupTransformAction)
        self.timeout_padding = timeout_padding
        if check_frequency is not None:
            rospy.logwarn("BufferClient: check_frequency is deprecated; it has no effect")

    def wait_for_server(self, timeout: genpy.Duration = _NO_WAIT) -> bool:
        """Wait for the server; False after the timeout."""
        return self.client.wait_for_server(timeout)

    def lookup_transform(
        self, target_frame: str, source_frame: str, time: genpy.Time, timeout: genpy.Duration = _NO_WAIT
    ) -> Any:
        """See `Buffer.lookup_transform`."""
        goal = LookupTransformGoal(
            target_frame=target_frame, source_frame=source_frame, source_time=time, timeout=timeout, advanced=False
        )
        return self._request(goal)

    def lookup_transform_full(
        self,
        target_frame: str,
        target_time: genpy.Time,
        source_frame: str,
        source_time: genpy.Time,
        fixed_frame: str,
        timeout: genpy.Duration = _NO_WAIT,
    ) -> Any:
        """See `Buffer.lookup_transform_full`."""
        goal = LookupTransformGoal(
            target_frame=target_frame,
            source_frame=source_frame,
            source_time=source_time,
            timeout=timeout,
            target_time=target_time,
            fixed_frame=fixed_frame,
            advanced=True,
        )
        return self._request(goal)

    def can_transform(
        self, target_frame: str, source_frame: str, time: genpy.Time, timeout: genpy.Duration = _NO_WAIT
    ) -> bool:
        """True if the lookup succeeds."""
        try:
            self.lookup_transform(target_frame, source_frame, time, timeout)
        except TransformException:
            return False
        return True

    def can_transform_full(
        self,
        target_frame: str,
        target_time: genpy.Time,
        source_frame: str,
        source_time: genpy.Time,
        fixed_frame: str,
        timeout: genpy.Duration = _NO_WAIT,
    ) -> bool:
        """True if the full lookup succeeds."""
        try:
            self.lookup_transform_full(target_frame, target_time, source_frame, source_time, fixed_frame, timeout)
        except TransformException:
            return False
        return True

    def _request(self, goal: Any) -> Any:
        self.client.send_goal(goal)
        if not self.client.wait_for_result(goal.timeout + self.timeout_padding):
            raise TimeoutException("the buffer server did not answer in time")
        state = self.client.get_state()
        if state != GoalStatus.SUCCEEDED:
            raise TimeoutException(f"the buffer server ended the goal with state {GoalStatus.to_string(state)}")
        result = self.client.get_result()
        if result is None:
            raise TransformException("the buffer server sent no result")
        if result.error.error != TF2Error.NO_ERROR:
            raise _ERRORS.get(result.error.error, TransformException)(result.error.error_string)
        return result.transform
