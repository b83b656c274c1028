"""Starting points: small robots, worlds, plugins, nodes, launch files and messages, each with its test."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
