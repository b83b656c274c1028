from .base_odometry import BaseOdometry as BaseOdometry
from .catalog import CONTROLLERS as CONTROLLERS
from .controller import (
    ControllerContext as ControllerContext,
    Endpoints as Endpoints,
    InStepController as InStepController,
)
from .diff_drive import DiffDriveController as DiffDriveController
from .gripper import FingersController as FingersController
from .hardware import JointHardware as JointHardware
from .joint_state import JointStateController as JointStateController
from .plugin import GazeboRosControl as GazeboRosControl
from .trajectory import PositionTrajectory as PositionTrajectory
from .transmissions import Interface as Interface
