"""Buffer that waits for transforms, and shows its frames to tf's tools."""

from collections.abc import Callable
from typing import Any

from tf2_msgs.srv import FrameGraph, FrameGraphResponse

import genpy
import rosgraph.masterapi
import rospy
from tf2_py import BufferCore

from .buffer_interface import BufferInterface

DEFAULT_CAN_TRANSFORM_POLLING_SCALE = 0.01

_NO_WAIT = rospy.Duration(0.0)
_LOOP_JUMP = rospy.Duration(3.0)
"""Jump back in time after which waiting ends: a bag restarted."""


class Buffer(BufferCore, BufferInterface):
    """Transforms of the last seconds; a TransformListener fills it."""

    def __init__(self, cache_time: genpy.Duration | None = None, debug: bool = True) -> None:
        """Start empty.

        Args:
            cache_time: rospy.Duration to keep transforms for; None: 10 s.
            debug: offer the service `~tf2_frames`, unless this node already does; needs rospy.init_node.
        """
        BufferCore.__init__(self, cache_time)
        BufferInterface.__init__(self)
        self.CAN_TRANSFORM_POLLING_SCALE = DEFAULT_CAN_TRANSFORM_POLLING_SCALE
        if debug:
            try:
                rosgraph.masterapi.Master(rospy.get_name()).lookupService("~tf2_frames")
            except (rosgraph.masterapi.Error, rosgraph.masterapi.Failure):
                self.frame_server = rospy.Service("~tf2_frames", FrameGraph, self._answer_frames)

    def _answer_frames(self, _request: Any) -> Any:
        return FrameGraphResponse(self.all_frames_as_yaml())

    def lookup_transform(
        self, target_frame: str, source_frame: str, time: genpy.Time, timeout: genpy.Duration = _NO_WAIT
    ) -> Any:
        """TransformStamped of the source in the target frame.

        Args:
            target_frame: parent of the result.
            source_frame: child of the result.
            time: rospy.Time; 0 is the latest common time.
            timeout: rospy.Duration to wait for it.

        Raises:
            tf2_ros.TransformException: there is no such transform, even after the wait.
        """
        self.can_transform(target_frame, source_frame, time, timeout)
        return self.lookup_transform_core(target_frame, source_frame, time)

    def lookup_transform_full(
        self,
        target_frame: str,
        target_time: genpy.Time,
        source_frame: str,
        source_time: genpy.Time,
        fixed_frame: str,
        timeout: genpy.Duration = _NO_WAIT,
    ) -> Any:
        """TransformStamped of the source at one time in the target at another; see `lookup_transform`."""
        self.can_transform_full(target_frame, target_time, source_frame, source_time, fixed_frame, timeout)
        return self.lookup_transform_full_core(target_frame, target_time, source_frame, source_time, fixed_frame)

    def can_transform(
        self,
        target_frame: str,
        source_frame: str,
        time: genpy.Time,
        timeout: genpy.Duration = _NO_WAIT,
        return_debug_tuple: bool = False,
    ) -> Any:
        """True if the lookup would succeed within the timeout; with `return_debug_tuple` also the error's text."""
        return self._wait(
            lambda: self.can_transform_core(target_frame, source_frame, time), timeout, return_debug_tuple
        )

    def can_transform_full(
        self,
        target_frame: str,
        target_time: genpy.Time,
        source_frame: str,
        source_time: genpy.Time,
        fixed_frame: str,
        timeout: genpy.Duration = _NO_WAIT,
        return_debug_tuple: bool = False,
    ) -> Any:
        """True if the full lookup would succeed; see `can_transform`."""
        return self._wait(
            lambda: self.can_transform_full_core(target_frame, target_time, source_frame, source_time, fixed_frame),
            timeout,
            return_debug_tuple,
        )

    def _wait(self, query: Callable[[], tuple[int, str]], timeout: genpy.Duration, return_debug_tuple: bool) -> Any:
        """Repeat a query until it succeeds or times out, in ROS time."""
        result = query()
        if timeout != _NO_WAIT and not result[0]:
            start = now = rospy.Time.now()
            while not result[0] and now < start + timeout and now + _LOOP_JUMP >= start:
                rospy.sleep(timeout * self.CAN_TRANSFORM_POLLING_SCALE)
                now = rospy.Time.now()
                result = query()
        return result if return_debug_tuple else result[0]
