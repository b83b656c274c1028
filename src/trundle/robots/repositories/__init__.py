"""Published repositories of ROS packages, by the names that rosdep and apt know them by."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
