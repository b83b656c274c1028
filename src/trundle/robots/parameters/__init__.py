"""Named parameters with typed access: of SDF plugins, and of the ROS graph."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
