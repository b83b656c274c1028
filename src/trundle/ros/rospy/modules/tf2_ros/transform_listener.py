"""Subscriber that fills a buffer."""

import threading

from tf2_msgs.msg import TFMessage

import rospy


class TransformListener:
    """Passes /tf and /tf_static on to a buffer."""

    def __init__(self, buffer, queue_size=None, buff_size=65536, tcp_nodelay=False):
        """Subscribe.

        Args:
            buffer: object with set_transform, set_transform_static and clear.
            queue_size: see rospy.Subscriber, as the following.
            buff_size: [bytes].
            tcp_nodelay: ask the publishers to send at once.
        """
        self.buffer = buffer
        self.last_update = rospy.Time.now()
        self.last_update_lock = threading.Lock()
        options = {"queue_size": queue_size, "buff_size": buff_size, "tcp_nodelay": tcp_nodelay}
        self.tf_sub = rospy.Subscriber("/tf", TFMessage, self.callback, **options)
        self.tf_static_sub = rospy.Subscriber("/tf_static", TFMessage, self.static_callback, **options)

    def __del__(self):
        self.unregister()

    def unregister(self):
        """Unsubscribe."""
        for name in ("tf_sub", "tf_static_sub"):
            subscriber = getattr(self, name, None)
            if subscriber is not None:
                subscriber.unregister()

    def check_for_reset(self):
        """Clear the buffer if the time jumped back."""
        with self.last_update_lock:
            now = rospy.Time.now()
            if now < self.last_update:
                rospy.logwarn(f"tf: time jumped back by {(self.last_update - now).to_sec():f} s; the buffer is cleared")
                self.buffer.clear()
            self.last_update = now

    def callback(self, data):
        """Store a message of /tf."""
        self.check_for_reset()
        caller = data._connection_header.get("callerid", "default_authority")
        for transform in data.transforms:
            self.buffer.set_transform(transform, caller)

    def static_callback(self, data):
        """Store a message of /tf_static."""
        self.check_for_reset()
        caller = data._connection_header.get("callerid", "default_authority")
        for transform in data.transforms:
            self.buffer.set_transform_static(transform, caller)
