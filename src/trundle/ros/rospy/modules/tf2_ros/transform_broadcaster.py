"""Publisher of moving transforms."""

from typing import Any

from tf2_msgs.msg import TFMessage

import rospy


class TransformBroadcaster:
    """Publishes on /tf."""

    def __init__(self) -> None:
        self.pub_tf = rospy.Publisher("/tf", TFMessage, queue_size=100)

    def sendTransform(self, transform: Any) -> None:
        """Send one TransformStamped, or a list of them in one message."""
        self.pub_tf.publish(TFMessage(transform if isinstance(transform, list) else [transform]))
