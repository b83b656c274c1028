"""Unique IDs of goals."""

import itertools
from typing import Any

from actionlib_msgs.msg import GoalID

import rospy

_counter = itertools.count(1)


class GoalIDGenerator:
    """Generates IDs from a name, a counter of this process, and the time."""

    def __init__(self, name: str | None = None) -> None:
        """Create with a name; default: the node's name."""
        self.set_name(rospy.get_name() if name is None else name)

    def set_name(self, name: str) -> None:
        """Change the name."""
        self.name = name

    def generate_ID(self) -> Any:
        """Next GoalID, stamped now."""
        stamp = rospy.Time.now()
        return GoalID(id=f"{self.name}-{next(_counter)}-{stamp.secs}.{stamp.nsecs}", stamp=stamp)
