"""Buffer that waits for transforms, and shows its frames to tf's tools."""

from tf2_msgs.srv import FrameGraph, FrameGraphResponse

import rosgraph.masterapi
import rospy
from tf2_py import BufferCore

from .buffer_interface import BufferInterface

DEFAULT_CAN_TRANSFORM_POLLING_SCALE = 0.01

_NO_WAIT = rospy.Duration(0.0)
_LOOP_JUMP = rospy.Duration(3.0)
"""A jump back in time of this is a bag starting again: waiting ends."""


class Buffer(BufferCore, BufferInterface):
    """Transforms of the last seconds; a TransformListener fills it."""

    def __init__(self, cache_time=None, debug=True):
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

    def _answer_frames(self, _request):
        return FrameGraphResponse(self.all_frames_as_yaml())

    def lookup_transform(self, target_frame, source_frame, time, timeout=_NO_WAIT):
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
        self, target_frame, target_time, source_frame, source_time, fixed_frame, timeout=_NO_WAIT
    ):
        """TransformStamped of the source at one time in the target at another; see `lookup_transform`."""
        self.can_transform_full(target_frame, target_time, source_frame, source_time, fixed_frame, timeout)
        return self.lookup_transform_full_core(target_frame, target_time, source_frame, source_time, fixed_frame)

    def can_transform(self, target_frame, source_frame, time, timeout=_NO_WAIT, return_debug_tuple=False):
        """True if the lookup would succeed within the timeout; with `return_debug_tuple` (that, why not)."""
        return self._wait(
            lambda: self.can_transform_core(target_frame, source_frame, time), timeout, return_debug_tuple
        )

    def can_transform_full(
        self,
        target_frame,
        target_time,
        source_frame,
        source_time,
        fixed_frame,
        timeout=_NO_WAIT,
        return_debug_tuple=False,
    ):
        """True if the full lookup would succeed; see `can_transform`."""
        return self._wait(
            lambda: self.can_transform_full_core(target_frame, target_time, source_frame, source_time, fixed_frame),
            timeout,
            return_debug_tuple,
        )

    def _wait(self, ask, timeout, return_debug_tuple):
        """Ask until yes or the timeout's end, in ROS time."""
        answer = ask()
        if timeout != _NO_WAIT and not answer[0]:
            start = now = rospy.Time.now()
            while not answer[0] and now < start + timeout and now + _LOOP_JUMP >= start:
                rospy.sleep(timeout * self.CAN_TRANSFORM_POLLING_SCALE)
                now = rospy.Time.now()
                answer = ask()
        return answer if return_debug_tuple else answer[0]
