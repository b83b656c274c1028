"""Velocity commands."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from trundle.ros import Node, Publisher

TWIST, TWIST_STAMPED = "geometry_msgs/Twist", "geometry_msgs/TwistStamped"


def publish_twist(node: "Node", publisher: "Publisher", linear: float, angular: float) -> None:
    """Publish a velocity [m/s, rad/s] as Twist or TwistStamped, by the topic's type."""
    twist = {"linear": {"x": linear}, "angular": {"z": angular}}
    fields = {"header": "auto", "twist": twist} if publisher.type == TWIST_STAMPED else twist
    publisher.publish(node.new(publisher.type, fields))
