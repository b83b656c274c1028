"""Planners of ROS' navigation: of ways through a costmap, and of velocities along them."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
