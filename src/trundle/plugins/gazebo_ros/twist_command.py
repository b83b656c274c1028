"""The velocity that a robot is told to have, on a topic of geometry_msgs/Twist."""

import math

from trundle.ros import Message, Node


class TwistCommand:
    """The last command; it holds until the next."""

    def __init__(self, node: Node, topic: str) -> None:
        """Subscribe."""
        self.forward = self.sideways = self.turning = 0.0
        """[m/s], [m/s] to the left, [rad/s] to the left."""
        self.stamp_ns = 0
        """When it came."""
        self._node = node
        node.subscribe(topic, "geometry_msgs/Twist", self._take, queue_size=1)

    def stop(self) -> None:
        """Ask for nothing."""
        self.forward = self.sideways = self.turning = 0.0

    def _take(self, twist: Message) -> None:
        wanted = (float(twist.linear.x), float(twist.linear.y), float(twist.angular.z))
        if all(map(math.isfinite, wanted)):
            self.forward, self.sideways, self.turning = wanted
            self.stamp_ns = self._node.clock.now_ns()
