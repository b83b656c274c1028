"""Publisher of transforms that never change."""

from typing import Any

from tf2_msgs.msg import TFMessage

import rospy


class StaticTransformBroadcaster:
    """Publishes on /tf_static, latched: every message carries all transforms sent so far."""

    def __init__(self) -> None:
        self.pub_tf = rospy.Publisher("/tf_static", TFMessage, queue_size=100, latch=True)
        self.net_message = TFMessage()

    def sendTransform(self, transform: Any) -> None:
        """Send one TransformStamped or a list of them; the last one of each child is kept."""
        latest = {sent.child_frame_id: sent for sent in self.net_message.transforms}
        for update in transform if isinstance(transform, list) else [transform]:
            latest[update.child_frame_id] = update
        self.net_message = TFMessage(list(latest.values()))
        self.pub_tf.publish(self.net_message)
