"""Velocity command on a topic of geometry_msgs/Twist."""

import math
from typing import TYPE_CHECKING, Self

from trundle.parameters import TagParameters
from trundle.ros import Node

from .namespaces import join_topic

if TYPE_CHECKING:
    from trundle.ros.message_types import geometry_msgs


class TwistCommand:
    """Last command; it holds until the next."""

    def __init__(self, node: Node, topic: str) -> None:
        """Subscribe."""
        self.forward = self.sideways = self.yaw_rate = 0.0
        """Forward [m/s], left [m/s], counter-clockwise [rad/s]."""
        self.stamp_ns = 0
        """Time of arrival [ns]."""
        self._node = node
        node.subscribe(topic, "geometry_msgs/Twist", self._on_command, queue_size=1)

    @classmethod
    def from_tag(cls, parameters: TagParameters, namespace: str, node: Node) -> Self:
        """Read <commandTopic>, the parameter of every gazebo_ros drive."""
        return cls(node, join_topic(namespace, parameters.text("commandTopic", "cmd_vel")))

    def stop(self) -> None:
        """Set the command to zero."""
        self.forward = self.sideways = self.yaw_rate = 0.0

    def _on_command(self, twist: "geometry_msgs.Twist") -> None:
        wanted = (float(twist.linear.x), float(twist.linear.y), float(twist.angular.z))
        if all(map(math.isfinite, wanted)):
            self.forward, self.sideways, self.yaw_rate = wanted
            self.stamp_ns = self._node.clock.now_ns()
