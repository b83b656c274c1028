"""move_base/move_base: drives the robot to goals by two costmaps, two planners and recovery behaviors."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
