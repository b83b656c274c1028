"""Snapshots and sensor readings as ROS messages: sensor topics, /clock, joint_states and tf."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
