"""Bags: recorded, played, read and written, as ROS 1 bags and as MCAP."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
