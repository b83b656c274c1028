"""Model plugins of hector_gazebo_plugins, by file name."""
