"""robot_localization: fuses odometry, imus, poses and twists into an estimate of the robot's pose."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
