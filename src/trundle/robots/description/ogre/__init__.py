"""Colors and textures of Ogre material scripts, referenced by SDF's <material><script>."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
