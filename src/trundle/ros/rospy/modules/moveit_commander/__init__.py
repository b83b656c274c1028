"""Not available: moveit_commander wraps MoveIt's C++ libraries."""

raise ImportError(
    "moveit_commander needs MoveIt, which is compiled for one Linux release and cannot come with Trundle. Ways out: "
    "run move_group and this node in a container with ROS Noetic (osrf/ros:noetic-desktop-full and "
    "ros-noetic-moveit) with ROS_MASTER_URI naming Trundle's master; or send trajectories yourself to the "
    "follow_joint_trajectory action of the robot's controller, with actionlib and control_msgs"
)
