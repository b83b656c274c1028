"""Expiry of a goal after its last handle."""

from typing import TYPE_CHECKING, Any

import rospy

if TYPE_CHECKING:
    from .status_tracker import StatusTracker


class HandleTrackerDeleter:
    """Callable that starts the timeout after which the server forgets a goal."""

    def __init__(self, action_server: Any, status_tracker: "StatusTracker") -> None:
        self.action_server = action_server
        self.status_tracker = status_tracker

    def __call__(self, ptr: object) -> None:
        if self.action_server:
            with self.action_server.lock:
                self.status_tracker.handle_destruction_time = rospy.Time.now()
                self.status_tracker.handle_tracker = None
