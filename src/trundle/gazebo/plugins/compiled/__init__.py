"""Plugins of Gazebo in C++, compiled with the development kit, which run inside the step."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
