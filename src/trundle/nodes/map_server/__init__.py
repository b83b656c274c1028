"""map_server's two nodes: a map from a picture onto /map, and from /map into a picture."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
