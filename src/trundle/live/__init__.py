"""Worlds and graphs in motion: a run, a launch, the simulation behind /gazebo."""
