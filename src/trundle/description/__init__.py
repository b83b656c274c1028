"""Text becomes model, and model text: SDF, URDF and xacro, each by its own rules."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
