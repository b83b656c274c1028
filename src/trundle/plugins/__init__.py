"""The simulator driven from ROS, and publishing to it: Gazebo plugins by their file names."""

from .catalog import BUILTIN, find_plugin, find_world_plugin
from .plugin import Hooks, Plugin, WorldPlugin

__all__ = ["BUILTIN", "Hooks", "Plugin", "WorldPlugin", "find_plugin", "find_world_plugin"]
