"""Expressions that a file holds: text and names enter, a value leaves; no code of Python runs."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
