"""Gazebo's plugins, and the nodes that Trundle runs in place of packages' own."""
