"""Differences of a run from a reference: poses of models and positions of joints at the same time since the start."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
