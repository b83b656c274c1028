"""libgazebo_grasp_fix.so: welds an object to the palm while fingers hold it."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
