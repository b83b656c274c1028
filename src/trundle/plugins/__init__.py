"""The simulator driven from ROS, and publishing to it: Gazebo plugins by their file names."""

from .catalog import BUILTIN, find_plugin
from .plugin import Plugin

__all__ = ["BUILTIN", "Plugin", "find_plugin"]
