"""Gazebo's own model and world plugins."""
