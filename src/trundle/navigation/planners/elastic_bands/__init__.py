"""Local planners that deform paths: teb_local_planner, eband_local_planner."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
