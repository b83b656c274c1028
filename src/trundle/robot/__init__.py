"""A URDF's own tree as written, and its kinematics."""

from .kinematics import parent_from_child, root_from_links
from .read import read_robot
from .robot import (
    JointLimit,
    Mimic,
    Robot,
    RobotBox,
    RobotCylinder,
    RobotGeometry,
    RobotInertial,
    RobotJoint,
    RobotJointType,
    RobotLink,
    RobotMesh,
    RobotShape,
    RobotSphere,
)

__all__ = [
    "JointLimit",
    "Mimic",
    "Robot",
    "RobotBox",
    "RobotCylinder",
    "RobotGeometry",
    "RobotInertial",
    "RobotJoint",
    "RobotJointType",
    "RobotLink",
    "RobotMesh",
    "RobotShape",
    "RobotSphere",
    "parent_from_child",
    "read_robot",
    "root_from_links",
]
