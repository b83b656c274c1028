"""geometry_msgs of poses, twists and wrenches, and the two halves of every answer of /gazebo."""

import math
from collections.abc import Callable
from typing import Any

from trundle.diagnostics import TrundleError
from trundle.ros import Message, Node
from trundle.simulation import expect_finite
from trundle.spatial import IDENTITY_QUATERNION, Pose, Twist, Vector3


def pose_fields(pose: Pose) -> dict[str, Any]:
    """A geometry_msgs/Pose."""
    w, x, y, z = pose.quaternion
    return {"position": vector_fields(pose.position), "orientation": {"x": x, "y": y, "z": z, "w": w}}


def vector_fields(vector: Vector3) -> dict[str, float]:
    """A geometry_msgs/Vector3 or Point."""
    return dict(zip("xyz", vector, strict=True))


def twist_fields(twist: Twist) -> dict[str, Any]:
    """A geometry_msgs/Twist."""
    return {"linear": vector_fields(twist.linear), "angular": vector_fields(twist.angular)}


def read_vector(message: Message) -> Vector3:
    """Read a Vector3 or Point.

    Raises:
        UsageError: a number is none, or endless.
    """
    expect_finite(message.x, message.y, message.z)
    return (float(message.x), float(message.y), float(message.z))


def read_pose(message: Message) -> Pose:
    """Read a Pose; an orientation of zeros, which a request that leaves it out holds, is none.

    Raises:
        UsageError: a number is none, or endless.
    """
    q = message.orientation
    expect_finite(q.w, q.x, q.y, q.z)
    length = math.hypot(q.w, q.x, q.y, q.z)
    turn = (q.w / length, q.x / length, q.y / length, q.z / length) if length > 0.0 else IDENTITY_QUATERNION
    return Pose(read_vector(message.position), turn)


def read_twist(message: Message) -> Twist:
    """Read a Twist.

    Raises:
        UsageError: a number is none, or endless.
    """
    return Twist(read_vector(message.linear), read_vector(message.angular))


def advertise_status_service(
    node: Node, name: str, kind: str, work: Callable[[Message], dict[str, Any]], done: str
) -> None:
    """Provide a service that says in `status_message` how it went, as those of gazebo_ros do.

    Args:
        node: /gazebo.
        name: of the service, in the node's namespace.
        kind: its type, of gazebo_msgs; what cannot be done is said after it.
        work: does it, and returns the response's other fields.
        done: the message of success.
    """

    def handle(request: Message) -> dict[str, Any]:
        try:
            return {"status_message": done, **work(request), "success": True}
        except TrundleError as error:
            return {"success": False, "status_message": f"{kind}: {error}"}

    node.advertise_service(f"~{name}", f"gazebo_msgs/{kind}", handle)
