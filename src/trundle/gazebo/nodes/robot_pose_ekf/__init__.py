"""robot_pose_ekf: fuses wheel odometry, an imu, visual odometry and GPS into the robot's pose."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
