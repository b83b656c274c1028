"""robot_localization: odometry, imus, poses and twists become one estimate of where the robot is."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
