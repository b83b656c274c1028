"""The ROS 1 graph: master, parameters, topics, services, tf and messages.

Names are imported on first use, so that commands that only call the master import neither asyncio nor numpy.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
