"""Exploration of unknown space: explore_lite, frontier_exploration, rrt_exploration."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
