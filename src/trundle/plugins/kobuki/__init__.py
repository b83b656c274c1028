"""libgazebo_ros_kobuki.so: the base of a TurtleBot 2."""

from .base import Kobuki

__all__ = ["Kobuki"]
