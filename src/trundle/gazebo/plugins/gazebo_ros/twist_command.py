"""Velocity command on a topic of geometry_msgs/Twist."""

import math
from typing import TYPE_CHECKING, Self

from trundle.robots.parameters import TagParameters

from .plugin_names import PluginNames

if TYPE_CHECKING:
    from trundle.ros.message_types import geometry_msgs


class TwistCommand:
    """Last command, which holds until the next one."""

    def __init__(self, names: PluginNames, topic: str) -> None:
        """Subscribe to geometry_msgs/Twist."""
        self.forward = self.sideways = self.yaw_rate = 0.0
        """Forward [m/s], left [m/s], counter-clockwise [rad/s]."""
        self.stamp_ns = 0
        """Time of arrival [ns]."""
        self._node = names.node
        names.subscribe(topic, "geometry_msgs/Twist", self._on_command)

    @classmethod
    def from_tag(cls, parameters: TagParameters, names: PluginNames) -> Self:
        """Read <commandTopic>, the parameter of every gazebo_ros drive; warn if it commands another model too."""
        name = parameters.text("commandTopic", "cmd_vel")
        topic = names.topic(name)
        for model, other_parameters, other_names in names.drives_before():
            if topic == other_names.topic(other_parameters.text("commandTopic", "cmd_vel")):
                problem = f"one command on {topic} moves this model and {model!r}"
                parameters.warn(f"{problem}; with a <robotNamespace> each has its own topic")
                break
        return cls(names, name)

    def stop(self) -> None:
        """Set the command to zero."""
        self.forward = self.sideways = self.yaw_rate = 0.0

    def _on_command(self, twist: "geometry_msgs.Twist") -> None:
        command = (float(twist.linear.x), float(twist.linear.y), float(twist.angular.z))
        if all(map(math.isfinite, command)):
            self.forward, self.sideways, self.yaw_rate = command
            self.stamp_ns = self._node.clock.now_ns()
