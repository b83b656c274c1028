"""Conversions of geometry_msgs, and the response pattern of /gazebo's services."""

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from trundle.base.diagnostics import TrundleError, UsageError
from trundle.ros import Message, Node
from trundle.spatial import IDENTITY_QUATERNION, Pose, Twist, Vector3

if TYPE_CHECKING:
    from trundle.ros.message_types import geometry_msgs


def pose_fields(pose: Pose) -> dict[str, object]:
    """Return the fields of a geometry_msgs/Pose."""
    w, x, y, z = pose.quaternion
    return {"position": vector_fields(pose.position), "orientation": {"x": x, "y": y, "z": z, "w": w}}


def vector_fields(vector: Vector3) -> dict[str, float]:
    """Return the fields of a geometry_msgs/Vector3 or Point."""
    return dict(zip("xyz", vector, strict=True))


def twist_fields(twist: Twist) -> dict[str, object]:
    """Return the fields of a geometry_msgs/Twist."""
    return {"linear": vector_fields(twist.linear), "angular": vector_fields(twist.angular)}


def read_vector(message: "geometry_msgs.Vector3") -> Vector3:
    """Convert a Vector3 or Point.

    Raises:
        UsageError: a number is not finite.
    """
    expect_finite(message.x, message.y, message.z)
    return (float(message.x), float(message.y), float(message.z))


def read_pose(message: "geometry_msgs.Pose") -> Pose:
    """Convert a Pose; an all-zero quaternion, the default in requests, is the identity.

    Raises:
        UsageError: a number is not finite.
    """
    orientation = message.orientation
    expect_finite(orientation.w, orientation.x, orientation.y, orientation.z)
    length = math.hypot(orientation.w, orientation.x, orientation.y, orientation.z)
    quaternion = (
        (orientation.w / length, orientation.x / length, orientation.y / length, orientation.z / length)
        if length > 0.0
        else IDENTITY_QUATERNION
    )
    return Pose(read_vector(message.position), quaternion)


def read_twist(message: "geometry_msgs.Twist") -> Twist:
    """Convert a Twist.

    Raises:
        UsageError: a number is not finite.
    """
    return Twist(read_vector(message.linear), read_vector(message.angular))


def advertise_status_service(
    node: Node, name: str, kind: str, handler: Callable[[Message], dict[str, object]], status_message: str
) -> None:
    """Advertise a service with `success` and `status_message`, like those of gazebo_ros.

    Args:
        node: node /gazebo.
        name: service name, in the node's namespace.
        kind: service type in gazebo_msgs, also the prefix of error messages.
        handler: handles a request and returns the response's other fields.
        status_message: `status_message` on success.
    """

    def handle(request: Message) -> dict[str, Any]:
        try:
            return {"status_message": status_message, **handler(request), "success": True}
        except TrundleError as error:
            return {"success": False, "status_message": f"{kind}: {error}"}

    node.advertise_service(f"~{name}", f"gazebo_msgs/{kind}", handle)


def expect_finite(*numbers: float) -> None:
    """Check for NaN and infinity, which would destroy the state.

    Raises:
        UsageError: a number is not finite.
    """
    if not all(map(math.isfinite, numbers)):
        raise UsageError(f"finite numbers are needed, got {', '.join(f'{number:g}' for number in numbers)}")
