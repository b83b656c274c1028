"""Trials: a plan of many runs, the values of each, and the table of their results."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
