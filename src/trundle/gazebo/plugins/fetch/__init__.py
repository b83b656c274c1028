"""libfetch_gazebo_plugin.so: the controllers of Fetch and Freight."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
