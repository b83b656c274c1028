"""What move_group knows of the world: objects, what the robot carries, allowed collisions; as messages change it."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
