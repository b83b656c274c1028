"""Plugins of unitree_gazebo."""
