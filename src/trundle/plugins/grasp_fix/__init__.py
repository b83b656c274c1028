"""libgazebo_grasp_fix.so: what fingers hold is welded to the palm while they hold it."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
