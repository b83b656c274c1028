"""Publisher of moving transforms, with the arguments of tf."""

from collections.abc import Sequence
from typing import Any

from geometry_msgs.msg import Quaternion, TransformStamped, Vector3

import genpy
import tf2_ros


class TransformBroadcaster:
    """Publishes on /tf."""

    def __init__(self, queue_size: int = 100) -> None:
        """Advertise; `queue_size` has no effect, as since tf uses tf2."""
        del queue_size
        self.tf2_broadcaster = tf2_ros.TransformBroadcaster()

    def sendTransform(
        self, translation: Sequence[float], rotation: Sequence[float], time: genpy.Time, child: str, parent: str
    ) -> None:
        """Send the pose of a frame in its parent.

        Args:
            translation: (x, y, z) [m].
            rotation: (x, y, z, w).
            time: stamp.
            child: frame's name.
            parent: its parent's name.
        """
        transform = TransformStamped(child_frame_id=child)
        transform.header.frame_id = parent
        transform.header.stamp = time
        transform.transform.translation = Vector3(*translation[:3])
        transform.transform.rotation = Quaternion(*rotation[:4])
        self.sendTransformMessage(transform)

    def sendTransformMessage(self, transform: Any) -> None:
        """Send a TransformStamped."""
        self.tf2_broadcaster.sendTransform([transform])
