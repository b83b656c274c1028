"""Drive laws and what controllers share."""

from .drive import DifferentialDrive, WheelOdometry, approach
from .four_wheel import FourWheelSteering, Wheels, axle_angle
from .pid import Pid
from .speed_limit import SpeedLimit
from .spline import JointPoint, JointSpline
from .toolbox_pid import ToolboxPid

__all__ = [
    "DifferentialDrive",
    "FourWheelSteering",
    "JointPoint",
    "JointSpline",
    "Pid",
    "SpeedLimit",
    "ToolboxPid",
    "WheelOdometry",
    "Wheels",
    "approach",
    "axle_angle",
]
