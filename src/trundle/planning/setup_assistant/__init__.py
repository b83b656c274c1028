"""Package of a robot for MoveIt: groups, collisions that need no check, controllers, launch files."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
