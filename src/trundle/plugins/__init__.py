"""The simulator driven from ROS, and publishing to it: Gazebo plugins by their file names."""

from .catalog import (
    BUILTIN,
    OF_SENSORS,
    find_model_sensor_plugin,
    find_plugin,
    find_sensor_plugin,
    find_world_plugin,
)
from .plugin import Hooks, Plugin, WorldPlugin

__all__ = [
    "BUILTIN",
    "OF_SENSORS",
    "Hooks",
    "Plugin",
    "WorldPlugin",
    "find_model_sensor_plugin",
    "find_plugin",
    "find_sensor_plugin",
    "find_world_plugin",
]
