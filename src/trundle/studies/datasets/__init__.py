"""Training data for vision: pictures with their annotations, as the formats of the field hold them."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
