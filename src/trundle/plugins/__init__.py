"""The simulator driven from ROS, and publishing to it: Gazebo plugins by their file names."""

from .catalog import (
    BUILTIN,
    OF_SENSORS,
    alters_looks_alone,
    find_model_sensor_plugin,
    find_plugin,
    find_sensor_plugin,
    find_visual_plugin,
    find_world_plugin,
)
from .plugin import Hooks, Plugin, VisualPlugin, WorldPlugin

__all__ = [
    "BUILTIN",
    "OF_SENSORS",
    "Hooks",
    "Plugin",
    "VisualPlugin",
    "WorldPlugin",
    "alters_looks_alone",
    "find_model_sensor_plugin",
    "find_plugin",
    "find_sensor_plugin",
    "find_visual_plugin",
    "find_world_plugin",
]
