"""Old messages brought up to the types of today, by rule files as rosbag has them."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
