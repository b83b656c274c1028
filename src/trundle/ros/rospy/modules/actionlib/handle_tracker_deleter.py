"""Time at which a goal's last handle goes."""

import rospy


class HandleTrackerDeleter:
    """Callable that starts the time after which the server forgets a goal."""

    def __init__(self, action_server, status_tracker):
        self.action_server = action_server
        self.status_tracker = status_tracker

    def __call__(self, ptr):
        if self.action_server:
            with self.action_server.lock:
                self.status_tracker.handle_destruction_time = rospy.Time.now()
                self.status_tracker.handle_tracker = None
