"""The C++ development kit: headers of messages, compiled libraries, builds of packages."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
