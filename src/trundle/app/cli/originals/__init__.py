"""Commands of ROS 1, catkin and Gazebo under their own names, for `trundle shell`.

Those with an equal command of Trundle are rows of the table; the others are command modules here.
"""

from .table import FUNCTIONS, ORIGINALS

__all__ = ["FUNCTIONS", "ORIGINALS"]
