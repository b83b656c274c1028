"""move_group: plans on request, executes by controllers, picks and places; MoveIt's node."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
