"""Nodes of topic_tools: relay, throttle, drop, multiplex and transform messages of any type."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
