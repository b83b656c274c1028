"""Timeline of the last minutes of a simulation: any moment can be restored exactly, and resumed."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
