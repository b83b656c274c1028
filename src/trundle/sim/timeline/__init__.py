"""The last minutes of a simulation, to go back to and to resume from exactly."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
