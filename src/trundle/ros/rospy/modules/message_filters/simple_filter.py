"""Base of filters."""

import rospy


class SimpleFilter:
    """Calls functions with each message that it lets through."""

    def __init__(self):
        self.callbacks = {}

    def registerCallback(self, cb, *args):
        """Call `cb` with each message, and with `args` after it; returns the callback's number."""
        number = len(self.callbacks)
        self.callbacks[number] = (cb, args)
        return number

    def signalMessage(self, *msg):
        """Call the functions."""
        for callback, args in list(self.callbacks.values()):
            callback(*(msg + args))


def stamp_of(message, allow_headerless):
    """Stamp of a message's header, or now if that is allowed; None (and a warning) if there is none."""
    stamp = getattr(getattr(message, "header", None), "stamp", None)
    if stamp is not None:
        return stamp
    if allow_headerless:
        return rospy.Time.now()
    rospy.logwarn(
        f"message_filters: {getattr(message, '_type', type(message).__name__)} has no header with a stamp; "
        "allow_headerless=True takes the time of arrival"
    )
    return None
