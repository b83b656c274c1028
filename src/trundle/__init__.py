"""Trundle runs the robots of the ROS 1 and Gazebo-classic world anywhere Python runs."""

__version__ = "0.1.0"
