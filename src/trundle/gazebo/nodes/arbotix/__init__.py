"""arbotix_python in its simulation mode, and the gripper controller of arbotix_controllers."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
