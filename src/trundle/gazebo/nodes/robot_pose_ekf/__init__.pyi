from .node import RobotPoseEkf as RobotPoseEkf
