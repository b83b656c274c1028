"""The nodes of topic_tools: messages of any type passed on, thinned out, chosen among or computed from."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
