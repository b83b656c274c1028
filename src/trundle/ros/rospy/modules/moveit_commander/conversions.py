"""Poses and transforms as lists, and messages as bytes."""

from collections.abc import Sequence
from typing import Any

from geometry_msgs.msg import Pose, PoseStamped, Transform

import rospy
from moveit_ros_planning_interface.robot_state import quaternion_from_rpy
from moveit_ros_planning_interface.serialization import to_bytes

from .exception import MoveItCommanderException


def msg_to_string(msg: Any) -> bytes:
    """Serialize a message."""
    return to_bytes(msg)


def msg_from_string(msg: Any, data: bytes) -> None:
    """Fill a message with serialized bytes."""
    msg.deserialize(data)


def pose_to_list(pose_msg: Any) -> list[float]:
    """Return x, y, z and the quaternion x, y, z, w of a geometry_msgs/Pose."""
    p, q = pose_msg.position, pose_msg.orientation
    return [p.x, p.y, p.z, q.x, q.y, q.z, q.w]


def list_to_pose(pose_list: Sequence[float]) -> Any:
    """Make a geometry_msgs/Pose of x, y, z and a quaternion x, y, z, w, or roll, pitch, yaw."""
    pose: Any = Pose()
    if len(pose_list) not in (6, 7):
        raise MoveItCommanderException("Expected either 6 or 7 elements in list: (x,y,z,r,p,y) or (x,y,z,qx,qy,qz,qw)")
    pose.position.x, pose.position.y, pose.position.z = pose_list[:3]
    rotation = pose_list[3:]
    numbers = rotation if len(rotation) == 4 else quaternion_from_rpy(*rotation)
    q = pose.orientation
    q.x, q.y, q.z, q.w = numbers
    return pose


def list_to_pose_stamped(pose_list: Sequence[float], target_frame: str) -> Any:
    """Make a geometry_msgs/PoseStamped of now."""
    pose: Any = PoseStamped()
    pose.pose = list_to_pose(pose_list)
    pose.header.frame_id, pose.header.stamp = target_frame, rospy.Time.now()
    return pose


def transform_to_list(trf_msg: Any) -> list[float]:
    """Return x, y, z and the quaternion x, y, z, w of a geometry_msgs/Transform."""
    t, q = trf_msg.translation, trf_msg.rotation
    return [t.x, t.y, t.z, q.x, q.y, q.z, q.w]


def list_to_transform(trf_list: Sequence[float]) -> Any:
    """Make a geometry_msgs/Transform of x, y, z and a quaternion x, y, z, w."""
    transform: Any = Transform()
    t, q = transform.translation, transform.rotation
    t.x, t.y, t.z, q.x, q.y, q.z, q.w = trf_list
    return transform
