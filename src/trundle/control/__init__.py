"""Drive laws and what controllers share."""

from .drive import DifferentialDrive, WheelOdometry, approach
from .pid import Pid
from .speed_limit import SpeedLimit
from .spline import JointPoint, JointSpline
from .toolbox_pid import ToolboxPid

__all__ = [
    "DifferentialDrive",
    "JointPoint",
    "JointSpline",
    "Pid",
    "SpeedLimit",
    "ToolboxPid",
    "WheelOdometry",
    "approach",
]
