"""Readers of SDF 1.0 to 1.12, each file by the rules of its version."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
