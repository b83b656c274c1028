"""Plugins of gazebo_plugins (gazebo_ros_pkgs): drives and sensor publishers, by file name."""
