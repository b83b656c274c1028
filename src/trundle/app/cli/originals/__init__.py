"""Commands of ROS 1, catkin and Gazebo under their own names, for `trundle shell`.

Those that a command of Trundle equals are rows of the table; the others are modules here, of a command's form.
"""

from .table import FUNCTIONS, ORIGINALS

__all__ = ["FUNCTIONS", "ORIGINALS"]
