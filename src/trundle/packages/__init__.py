"""Where files live: ROS packages, Gazebo models, worlds and what their URIs mean."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
