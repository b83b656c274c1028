"""geometry_msgs for tf2; importing it registers their stamped types for `Buffer.transform`."""

from geometry_msgs.msg import PointStamped, PoseStamped, Vector3Stamped, WrenchStamped

from .tf2_geometry_msgs import (
    do_transform_point,
    do_transform_pose,
    do_transform_vector3,
    do_transform_wrench,
    from_msg_msg,
    to_msg_msg,
    transform_to_kdl,
)

__all__ = [
    "PointStamped",
    "PoseStamped",
    "Vector3Stamped",
    "WrenchStamped",
    "do_transform_point",
    "do_transform_pose",
    "do_transform_vector3",
    "do_transform_wrench",
    "from_msg_msg",
    "to_msg_msg",
    "transform_to_kdl",
]
