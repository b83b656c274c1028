"""Markers that users of rviz can move and click."""
