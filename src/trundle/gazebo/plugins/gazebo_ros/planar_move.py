"""libgazebo_ros_planar_move.so: planar motion of a model by cmd_vel."""

import math

from trundle.robots.parameters import TagParameters
from trundle.ros import Node
from trundle.sim.simulation import ModelHandle, Simulation, Snapshot
from trundle.spatial import Twist

from .namespaces import rate_to_period_ns
from .odometry import LARGE_VARIANCE, OdometryTopic, ground_truth
from .ros_plugin import RosPlugin, plugin_names
from .twist_command import TwistCommand


class PlanarMove(RosPlugin):
    """Sets the model's velocity at every step, so that it neither falls nor tilts.

    Parameters, with gazebo_ros' defaults: <commandTopic> cmd_vel, <odometryTopic> odom, <odometryFrame> odom,
    <robotBaseFrame> base_footprint, <odometryRate> 20, <cmdTimeout> −1 [s] (none), <enableYAxis> true (false: it does
    not move sideways).
    """

    def __init__(self, sim: Simulation, model: ModelHandle, node: Node, parameters: TagParameters) -> None:
        names = plugin_names(sim, model, node, parameters)
        self._model = model
        self._command = TwistCommand.from_tag(parameters, names)
        self._moves_sideways = parameters.flag("enableYAxis", default=True)
        self._timeout_s = parameters.number("cmdTimeout", -1.0)
        self._publish_period_ns = rate_to_period_ns(parameters.number("odometryRate", 20.0))
        self._published_ns = sim.time_ns
        self._odometry = OdometryTopic.from_tag(
            parameters,
            names,
            variances=(1e-5, 1e-5, LARGE_VARIANCE, LARGE_VARIANCE, LARGE_VARIANCE, 1e-3),
            with_tf=True,
        )

    def before_step(self, sim: Simulation) -> None:
        """Set the model's velocity."""
        command = self._command
        if 0.0 < self._timeout_s < (sim.time_ns - command.stamp_ns) / 1e9:
            command.stop()
        yaw = self._model.pose.rpy[2]
        cos, sin = math.cos(yaw), math.sin(yaw)
        forward, sideways = command.forward, command.sideways if self._moves_sideways else 0.0
        linear = (cos * forward - sin * sideways, sin * forward + cos * sideways, 0.0)
        self._model.set_twist(Twist(linear, (0.0, 0.0, command.yaw_rate)))

    def after_step(self, snapshot: Snapshot) -> None:
        """Publish odometry at its rate."""
        if snapshot.time_ns < self._published_ns + self._publish_period_ns and snapshot.time_ns >= self._published_ns:
            return
        self._published_ns = snapshot.time_ns
        self._odometry.publish(snapshot.time_ns, *ground_truth(self._model))

    def reset(self) -> None:
        """Stop."""
        self._command.stop()
