"""Publisher of moving transforms, with the arguments of tf."""

from geometry_msgs.msg import Quaternion, TransformStamped, Vector3

import tf2_ros


class TransformBroadcaster:
    """Publishes on /tf."""

    def __init__(self, queue_size=100):
        """Advertise; `queue_size` has no effect, as since tf is built on tf2."""
        del queue_size
        self.tf2_broadcaster = tf2_ros.TransformBroadcaster()

    def sendTransform(self, translation, rotation, time, child, parent):
        """Send the pose of a frame in its parent.

        Args:
            translation: (x, y, z) [m].
            rotation: (x, y, z, w).
            time: rospy.Time.
            child: frame's name.
            parent: its parent's name.
        """
        transform = TransformStamped(child_frame_id=child)
        transform.header.frame_id = parent
        transform.header.stamp = time
        transform.transform.translation = Vector3(*translation[:3])
        transform.transform.rotation = Quaternion(*rotation[:4])
        self.sendTransformMessage(transform)

    def sendTransformMessage(self, transform):
        """Send a TransformStamped."""
        self.tf2_broadcaster.sendTransform([transform])
