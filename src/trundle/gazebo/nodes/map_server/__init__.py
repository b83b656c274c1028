"""map_server's nodes: publish a map from an image, and save /map as an image."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
