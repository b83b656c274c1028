"""Poses, twists and wrenches: rigid-body quantities as small immutable values, and their algebra on arrays."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
