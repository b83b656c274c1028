"""Shells in which the commands of ROS 1 and Gazebo are Trundle's."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
