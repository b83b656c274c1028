"""The ROS 1 graph by itself: master, parameters, topics, services, tf and messages.

Names are imported on first use: a command that only asks the master pays for neither asyncio nor numpy.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
