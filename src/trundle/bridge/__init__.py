"""Where the wings meet: snapshots and readings become messages on topics, /clock and tf."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
