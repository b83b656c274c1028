"""Maps from scans: gmapping, hector_mapping, and the pose graphs of Karto, slam_toolbox and Cartographer."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
