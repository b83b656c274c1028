"""Colours and textures from Ogre's material scripts, which SDF's <material><script> names."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
