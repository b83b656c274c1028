"""Steers as a car's driver does: the angle of the front wheel from speed and turning speed."""

import math
from typing import Any, Self

from trundle.gazebo.plugins import Plugin
from trundle.robots.model import PluginTag
from trundle.robots.parameters import TagParameters
from trundle.ros import Node
from trundle.sim.simulation import ModelHandle, Simulation


class SteerByTwist(Plugin):
    """Takes /cmd_vel, a Twist of the rear axle; publishes /steering: speed of the front wheel [m/s] and angle [rad]."""

    def __init__(self, node: Node, wheelbase_m: float, limit_rad: float) -> None:
        self._wheelbase_m, self._limit_rad = wheelbase_m, limit_rad
        self._steering = node.advertise("/steering", "geometry_msgs/Twist", queue_size=1)
        node.subscribe("/cmd_vel", "geometry_msgs/Twist", self._on_command, queue_size=1)

    @classmethod
    def load(cls, sim: Simulation, model: ModelHandle, node: Node | None, tag: PluginTag) -> Self:
        """Read wheelbase [m] and limit [rad]."""
        del model
        assert node is not None, "the launch has a graph"
        parameters = TagParameters(tag.node, sim.report)
        return cls(node, parameters.number("wheelbase"), parameters.number("limit"))

    def _on_command(self, message: Any) -> None:
        speed, turn = float(message.linear.x), float(message.angular.z)
        angle = math.atan(self._wheelbase_m * turn / speed) if speed else 0.0
        angle = min(max(angle, -self._limit_rad), self._limit_rad)
        self._steering.publish({"linear": {"x": speed / math.cos(angle)}, "angular": {"z": angle}})
