"""The simulator driven from ROS, and publishing to it: Gazebo plugins by their file names."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
