"""Unique IDs of goals."""

import itertools

from actionlib_msgs.msg import GoalID

import rospy

_counter = itertools.count(1)


class GoalIDGenerator:
    """Makes IDs of a name, a counter of this process, and the time."""

    def __init__(self, name=None):
        """Start with a name; default: the node's."""
        self.set_name(rospy.get_name() if name is None else name)

    def set_name(self, name):
        """Change the name."""
        self.name = name

    def generate_ID(self):
        """Next GoalID, stamped now."""
        stamp = rospy.Time.now()
        return GoalID(id=f"{self.name}-{next(_counter)}-{stamp.secs}.{stamp.nsecs}", stamp=stamp)
