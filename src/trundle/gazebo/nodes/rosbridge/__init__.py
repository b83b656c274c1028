"""rosbridge_server: the graph for web pages and programs that speak no ROS."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
