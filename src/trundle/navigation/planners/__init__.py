"""Planners of ROS' navigation: global ones find paths through a costmap, local ones choose velocities along them."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
