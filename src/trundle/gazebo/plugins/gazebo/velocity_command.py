"""Command topic of Gazebo's native drive plugins.

`~/<model>/vel_cmd` carries a Pose whose x is the speed and whose yaw is the turning rate; on the ROS graph it is
`/<model>/vel_cmd` with a geometry_msgs/Pose.
"""

import math
from typing import TYPE_CHECKING, Self

from trundle.robots.names import ros_name
from trundle.ros import Node
from trundle.sim.simulation import ModelHandle
from trundle.spatial import rpy_from_quaternion

if TYPE_CHECKING:
    from trundle.ros.message_types import geometry_msgs


class VelocityCommand:
    """Last commanded speeds; they hold until the next."""

    def __init__(self, topic: str, node: Node | None) -> None:
        self.speed = 0.0
        """Forward speed [m/s]."""
        self.yaw_rate = 0.0
        """Yaw rate [rad/s]."""
        if node is not None:
            node.subscribe(topic, "geometry_msgs/Pose", self._on_command)

    @classmethod
    def subscribe(cls, model: ModelHandle, node: Node | None) -> Self:
        """Subscribe to `/<model>/vel_cmd`."""
        return cls(f"/{ros_name(model.name)}/vel_cmd", node)

    def stop(self) -> None:
        """Set both speeds to zero."""
        self.speed = self.yaw_rate = 0.0

    def _on_command(self, pose: "geometry_msgs.Pose") -> None:
        turn = pose.orientation
        yaw = rpy_from_quaternion((turn.w, turn.x, turn.y, turn.z))[2]
        if math.isfinite(pose.position.x) and math.isfinite(yaw):
            self.speed, self.yaw_rate = float(pose.position.x), yaw
