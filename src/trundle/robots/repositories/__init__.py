"""Published repositories of ROS packages, by package name and rosdep key."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
