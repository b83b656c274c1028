"""Subscriber that adds transforms to a buffer."""

import threading
from typing import Any, Protocol

from tf2_msgs.msg import TFMessage

import rospy


class _Buffer(Protocol):
    def set_transform(self, transform: Any, authority: str) -> None: ...

    def set_transform_static(self, transform: Any, authority: str) -> None: ...

    def clear(self) -> None: ...


class TransformListener:
    """Passes /tf and /tf_static on to a buffer."""

    def __init__(
        self, buffer: _Buffer, queue_size: int | None = None, buff_size: int = 65536, tcp_nodelay: bool = False
    ) -> None:
        """Subscribe.

        Args:
            buffer: receives the transforms.
            queue_size: see rospy.Subscriber.
            buff_size: see rospy.Subscriber [bytes].
            tcp_nodelay: see rospy.Subscriber.
        """
        self.buffer = buffer
        self.last_update = rospy.Time.now()
        self.last_update_lock = threading.Lock()
        options: dict[str, Any] = {"queue_size": queue_size, "buff_size": buff_size, "tcp_nodelay": tcp_nodelay}
        self.tf_sub = rospy.Subscriber("/tf", TFMessage, self.callback, **options)
        self.tf_static_sub = rospy.Subscriber("/tf_static", TFMessage, self.static_callback, **options)

    def __del__(self) -> None:
        self.unregister()

    def unregister(self) -> None:
        """Unsubscribe."""
        for name in ("tf_sub", "tf_static_sub"):
            subscriber = getattr(self, name, None)
            if subscriber is not None:
                subscriber.unregister()

    def check_for_reset(self) -> None:
        """Clear the buffer if the time jumped back."""
        with self.last_update_lock:
            now = rospy.Time.now()
            if now < self.last_update:
                rospy.logwarn(f"tf: time jumped back by {(self.last_update - now).to_sec():f} s; the buffer is cleared")
                self.buffer.clear()
            self.last_update = now

    def callback(self, data: Any) -> None:
        """Store a message of /tf."""
        self.check_for_reset()
        caller = data._connection_header.get("callerid", "default_authority")
        for transform in data.transforms:
            self.buffer.set_transform(transform, caller)

    def static_callback(self, data: Any) -> None:
        """Store a message of /tf_static."""
        self.check_for_reset()
        caller = data._connection_header.get("callerid", "default_authority")
        for transform in data.transforms:
            self.buffer.set_transform_static(transform, caller)
