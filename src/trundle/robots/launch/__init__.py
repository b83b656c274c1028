"""Launch files: parsed from roslaunch XML into a plan; nothing is started here."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
