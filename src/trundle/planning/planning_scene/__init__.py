"""Planning scenes: what a robot may collide with, and whether it does."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
