"""Drive laws and what controllers share."""

from typing import TYPE_CHECKING

from trundle.doors import opened_on_use

if TYPE_CHECKING:
    from .drive import DifferentialDrive, WheelOdometry, approach
    from .four_wheel import FourWheelSteering, Wheels, axle_angle
    from .pid import Pid
    from .speed_limit import SpeedLimit
    from .spline import JointPoint, JointSpline
    from .toolbox_pid import ToolboxPid

_HOMES = {
    "DifferentialDrive": "drive",
    "FourWheelSteering": "four_wheel",
    "JointPoint": "spline",
    "JointSpline": "spline",
    "Pid": "pid",
    "SpeedLimit": "speed_limit",
    "ToolboxPid": "toolbox_pid",
    "WheelOdometry": "drive",
    "Wheels": "four_wheel",
    "approach": "drive",
    "axle_angle": "four_wheel",
}
__getattr__ = opened_on_use(__name__, _HOMES)

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
