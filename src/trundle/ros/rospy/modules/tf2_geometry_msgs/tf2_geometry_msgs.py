"""Transformation of stamped geometry messages by a TransformStamped; results have its header."""

from typing import Any, TypeVar

from geometry_msgs.msg import PointStamped, PoseStamped, Vector3Stamped, WrenchStamped

import tf2_ros
from PyKDL import Frame, Rotation, Vector

_T = TypeVar("_T")


def to_msg_msg(msg: _T) -> _T:
    """Return the message itself."""
    return msg


def from_msg_msg(msg: _T) -> _T:
    """Return the message itself."""
    return msg


def transform_to_kdl(t: Any) -> Frame:
    """PyKDL.Frame of a TransformStamped."""
    q, p = t.transform.rotation, t.transform.translation
    return Frame(Rotation.Quaternion(q.x, q.y, q.z, q.w), Vector(p.x, p.y, p.z))


def do_transform_point(point: Any, transform: Any) -> Any:
    """Transform a PointStamped."""
    result = PointStamped(header=transform.header)
    moved = transform_to_kdl(transform) * Vector(point.point.x, point.point.y, point.point.z)
    result.point.x, result.point.y, result.point.z = moved
    return result


def do_transform_vector3(vector3: Any, transform: Any) -> Any:
    """Rotate a Vector3Stamped."""
    result = Vector3Stamped(header=transform.header)
    turned = transform_to_kdl(transform).M * Vector(vector3.vector.x, vector3.vector.y, vector3.vector.z)
    result.vector.x, result.vector.y, result.vector.z = turned
    return result


def do_transform_pose(pose: Any, transform: Any) -> Any:
    """Transform a PoseStamped."""
    p, q = pose.pose.position, pose.pose.orientation
    frame = transform_to_kdl(transform) * Frame(Rotation.Quaternion(q.x, q.y, q.z, q.w), Vector(p.x, p.y, p.z))
    result = PoseStamped(header=transform.header)
    result.pose.position.x, result.pose.position.y, result.pose.position.z = frame.p
    orientation = result.pose.orientation
    orientation.x, orientation.y, orientation.z, orientation.w = frame.M.GetQuaternion()
    return result


def do_transform_wrench(wrench: Any, transform: Any) -> Any:
    """Rotate force and torque of a WrenchStamped."""
    result = WrenchStamped(header=transform.header)
    for part in ("force", "torque"):
        vector = Vector3Stamped(vector=getattr(wrench.wrench, part))
        setattr(result.wrench, part, do_transform_vector3(vector, transform).vector)
    return result


def _register() -> None:
    transforms, conversions = tf2_ros.TransformRegistration(), tf2_ros.ConvertRegistration()
    for message_type, function in (
        (PointStamped, do_transform_point),
        (Vector3Stamped, do_transform_vector3),
        (PoseStamped, do_transform_pose),
        (WrenchStamped, do_transform_wrench),
    ):
        transforms.add(message_type, function)
    for message_type in (PointStamped, Vector3Stamped, PoseStamped):
        conversions.add_to_msg(message_type, to_msg_msg)
        conversions.add_from_msg(message_type, from_msg_msg)


_register()
