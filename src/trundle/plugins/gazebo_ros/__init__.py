"""gazebo_plugins of gazebo_ros_pkgs: what drives robots from ROS and publishes what they feel, by file name."""
