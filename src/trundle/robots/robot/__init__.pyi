from .kinematics import parent_from_child as parent_from_child, root_from_links as root_from_links
from .read import read_robot as read_robot
from .urdf_tree import (
    JointLimit as JointLimit,
    Robot as Robot,
    RobotBox as RobotBox,
    RobotCylinder as RobotCylinder,
    RobotGeometry as RobotGeometry,
    RobotInertial as RobotInertial,
    RobotJoint as RobotJoint,
    RobotJointType as RobotJointType,
    RobotLink as RobotLink,
    RobotMesh as RobotMesh,
    RobotMimic as RobotMimic,
    RobotSafety as RobotSafety,
    RobotShape as RobotShape,
    RobotSphere as RobotSphere,
)
