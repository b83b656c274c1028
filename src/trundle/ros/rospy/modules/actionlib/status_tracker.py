"""Status of one goal at its server."""

from actionlib_msgs.msg import GoalStatus

import rospy

from .goal_id_generator import GoalIDGenerator


class StatusTracker:
    """Status of a goal, and how long to go on saying it."""

    def __init__(self, goal_id=None, status=None, goal=None):
        """Track a goal, or a cancel request (goal_id, status) whose goal has not come yet."""
        self.goal = goal
        self.handle_tracker = None
        self.handle_destruction_time = rospy.Time()
        """Time at which the last handle went, or the goal ended; 0 before."""
        self.status = GoalStatus()
        if goal is None:
            self.status.goal_id = goal_id
            self.status.status = status
            return
        self.status.goal_id = goal.goal_id
        self.status.status = GoalStatus.PENDING
        if self.status.goal_id.id == "":
            self.status.goal_id = GoalIDGenerator().generate_ID()
        if self.status.goal_id.stamp == rospy.Time():
            self.status.goal_id.stamp = rospy.Time.now()
