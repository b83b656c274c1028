"""Markers that can be moved and clicked in rviz."""
