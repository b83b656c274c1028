"""Migration of messages of old types to current ones, by rosbag's rule files."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
