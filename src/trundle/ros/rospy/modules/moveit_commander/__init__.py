"""MoveIt's commands for Python programs: groups, the robot, the planning scene.

Programs also take message classes, rospy and Python's modules from here, as in `moveit_commander.os._exit(0)`: the
original's modules are all imported with a star.
"""

import os
import re
import time
from types import ModuleType

from geometry_msgs.msg import Point, Pose, PoseStamped
from moveit_msgs.msg import (
    AllowedCollisionEntry,
    AllowedCollisionMatrix,
    AttachedCollisionObject,
    CollisionObject,
    Constraints,
    Grasp,
    MotionPlanRequest,
    MoveItErrorCodes,
    PlaceLocation,
    PlannerInterfaceDescription,
    PlanningScene,
    RobotState,
    RobotTrajectory,
    TrajectoryConstraints,
)
from moveit_msgs.srv import ApplyPlanningScene, ApplyPlanningSceneRequest
from sensor_msgs.msg import JointState
from shape_msgs.msg import Mesh, MeshTriangle, Plane, SolidPrimitive
from visualization_msgs.msg import MarkerArray

import rospy

from . import conversions
from .exception import MoveItCommanderException
from .interpreter import MoveGroupCommandInterpreter, MoveGroupInfoLevel
from .move_group import MoveGroupCommander
from .planning_scene_interface import PlanningSceneInterface
from .robot import RobotCommander
from .roscpp_initializer import roscpp_initialize, roscpp_shutdown

__all__ = [
    "AllowedCollisionEntry",
    "AllowedCollisionMatrix",
    "ApplyPlanningScene",
    "ApplyPlanningSceneRequest",
    "AttachedCollisionObject",
    "CollisionObject",
    "Constraints",
    "Grasp",
    "JointState",
    "MarkerArray",
    "Mesh",
    "MeshTriangle",
    "MotionPlanRequest",
    "MoveGroupCommandInterpreter",
    "MoveGroupCommander",
    "MoveGroupInfoLevel",
    "MoveItCommanderException",
    "MoveItErrorCodes",
    "PlaceLocation",
    "Plane",
    "PlannerInterfaceDescription",
    "PlanningScene",
    "PlanningSceneInterface",
    "Point",
    "Pose",
    "PoseStamped",
    "RobotCommander",
    "RobotState",
    "RobotTrajectory",
    "SolidPrimitive",
    "TrajectoryConstraints",
    "conversions",
    "os",
    "re",
    "roscpp_initialize",
    "roscpp_shutdown",
    "rospy",
    "time",
]


def __getattr__(name: str) -> ModuleType:
    """Import tf when a program asks for it: most do not."""
    if name == "tf":
        import tf

        return tf
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
