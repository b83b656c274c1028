"""Initialization and end, which programs call first and last."""

from collections.abc import Sequence

from moveit_ros_planning_interface import _moveit_roscpp_initializer


def roscpp_initialize(args: Sequence[str]) -> None:
    """Take remappings from a command line; the node's own name is rospy.init_node's."""
    arguments = [argument for argument in args if not argument.startswith("__name:=")]
    _moveit_roscpp_initializer.roscpp_init("move_group_commander_wrappers", arguments)


def roscpp_shutdown() -> None:
    """End the connections to move_group, with the program."""
    _moveit_roscpp_initializer.roscpp_shutdown()
