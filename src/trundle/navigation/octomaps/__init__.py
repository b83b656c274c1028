"""Maps of cubes in space, as octomap's: octomap_server and octomap_saver."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
