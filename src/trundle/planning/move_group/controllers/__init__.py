"""Controllers that execute trajectories: of ros_control, of drivers by actions, and fake ones."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
