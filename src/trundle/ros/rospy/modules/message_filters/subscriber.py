"""Subscription as a filter."""

from typing import Any

import rospy

from .simple_filter import SimpleFilter


class Subscriber(SimpleFilter):
    """rospy.Subscriber whose messages go to the registered functions."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        """Subscribe; arguments as of rospy.Subscriber, without the callback."""
        super().__init__()
        self.topic = args[0]
        kwargs["callback"] = self.callback
        self.sub = rospy.Subscriber(*args, **kwargs)

    def callback(self, msg: Any) -> None:
        """Pass a message on."""
        self.signalMessage(msg)

    def getTopic(self) -> str:
        """Topic's name, before remapping."""
        return self.topic

    def __getattr__(self, key: str) -> Any:
        if key == "sub":
            raise AttributeError(key)
        return getattr(self.sub, key)
