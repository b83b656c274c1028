"""Subscription as a filter."""

import rospy

from .simple_filter import SimpleFilter


class Subscriber(SimpleFilter):
    """rospy.Subscriber whose messages go to the registered functions."""

    def __init__(self, *args, **kwargs):
        """Subscribe; arguments as of rospy.Subscriber, without the callback."""
        super().__init__()
        self.topic = args[0]
        kwargs["callback"] = self.callback
        self.sub = rospy.Subscriber(*args, **kwargs)

    def callback(self, msg):
        """Pass a message on."""
        self.signalMessage(msg)

    def getTopic(self):
        """The topic's name, as given."""
        return self.topic

    def __getattr__(self, key):
        if key == "sub":
            raise AttributeError(key)
        return getattr(self.sub, key)
