"""gazebo_ros: the node /gazebo with its services and topics, spawn_model, and the window."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
