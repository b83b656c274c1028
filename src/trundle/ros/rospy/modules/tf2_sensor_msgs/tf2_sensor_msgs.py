"""Transformation of PointCloud2 by a TransformStamped."""

from typing import Any, TypeVar

import numpy as np
from sensor_msgs.msg import PointCloud2

import tf2_ros
from PyKDL import Frame, Rotation, Vector
from sensor_msgs.point_cloud2 import create_cloud, read_points

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


def do_transform_cloud(cloud: Any, transform: Any) -> Any:
    """Transform the points of a PointCloud2 whose first three fields are x, y and z; other fields stay."""
    frame = transform_to_kdl(transform)
    rotation = np.array([[frame.M[row, column] for column in range(3)] for row in range(3)])
    points = np.array(list(read_points(cloud)), dtype=np.float64)
    if len(points):
        points[:, :3] = points[:, :3] @ rotation.T + tuple(frame.p)
    return create_cloud(transform.header, cloud.fields, points)


tf2_ros.TransformRegistration().add(PointCloud2, do_transform_cloud)
tf2_ros.ConvertRegistration().add_to_msg(PointCloud2, to_msg_msg)
tf2_ros.ConvertRegistration().add_from_msg(PointCloud2, from_msg_msg)
