"""MoveIt's commands for Python programs: groups, the robot, the planning scene.

Programs also take message classes and rospy from here: the original's modules are all imported with a star.
"""

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
    "roscpp_initialize",
    "roscpp_shutdown",
    "rospy",
]
