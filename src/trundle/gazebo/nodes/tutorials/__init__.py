"""Nodes of the tutorials: rospy_tutorials, roscpp_tutorials, turtle_tf and turtle_tf2."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
