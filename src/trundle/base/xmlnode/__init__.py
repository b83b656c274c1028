"""XML tree with file, line and unread elements; the only user of lxml."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
