"""Base class of filters."""

from collections.abc import Callable
from typing import Any

import genpy
import rospy


class SimpleFilter:
    """Calls the registered functions with each message that passes."""

    def __init__(self) -> None:
        self.callbacks: dict[int, tuple[Callable[..., object], tuple[Any, ...]]] = {}

    def registerCallback(self, cb: Callable[..., object], *args: Any) -> int:
        """Call `cb` with each message and `args`; returns the callback's number."""
        number = len(self.callbacks)
        self.callbacks[number] = (cb, args)
        return number

    def signalMessage(self, *msg: Any) -> None:
        """Call the functions."""
        for callback, args in list(self.callbacks.values()):
            callback(*(msg + args))


def stamp_of(message: Any, allow_headerless: bool) -> genpy.Time | None:
    """Stamp of a message's header; without one the current time if allowed, else None and a warning."""
    stamp = getattr(getattr(message, "header", None), "stamp", None)
    if stamp is not None:
        return stamp
    if allow_headerless:
        return rospy.Time.now()
    rospy.logwarn(
        f"message_filters: {getattr(message, '_type', type(message).__name__)} has no header with a stamp; "
        "allow_headerless=True uses the time of arrival"
    )
    return None
