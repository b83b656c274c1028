"""Differences of a run from a reference at the same time since the start: poses, velocities, positions of joints."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
