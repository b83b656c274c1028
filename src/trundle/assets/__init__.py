"""Files that Trundle brings: models, worlds, ROS packages and message definitions; no code."""

from pathlib import Path

ASSETS = Path(__file__).parent
"""Folder of `models`, `stand_ins` and `worlds`, laid out as /usr/share/gazebo, of ROS packages and of messages."""
