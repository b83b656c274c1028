from ._servo import (
    DiffDriveLaw as DiffDriveLaw,
    GripperLaw as GripperLaw,
    MimicAction as MimicAction,
    PidLoop as PidLoop,
    Servo as Servo,
    ServoHardware as ServoHardware,
    ServoJoint as ServoJoint,
    ServoLaw as ServoLaw,
    ToolboxPid as ToolboxPid,
    TrajectoryLaw as TrajectoryLaw,
)
from .drive import DifferentialDrive as DifferentialDrive, WheelOdometry as WheelOdometry, step_towards as step_towards
from .four_wheel import FourWheelSteering as FourWheelSteering, Wheels as Wheels, axle_angle as axle_angle
from .mecanum import MecanumDrive as MecanumDrive
from .pid import Pid as Pid
from .speed_limit import SpeedLimit as SpeedLimit
from .spline import JointSegment as JointSegment, JointState as JointState
