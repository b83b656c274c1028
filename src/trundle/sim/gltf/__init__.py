"""Writer of glTF 2.0: scenes with their meshes, textures and lights, for browsers and modelling programs."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
