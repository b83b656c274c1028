"""catkin without CMake: packages, workspaces, and devel spaces, through which shells find the packages."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
