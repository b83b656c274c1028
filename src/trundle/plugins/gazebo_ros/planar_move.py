"""libgazebo_ros_planar_move.so: a model that slides over the plane as cmd_vel says."""

import math

from trundle.model import PluginTag
from trundle.ros import Node
from trundle.simulation import ModelHandle, Simulation, Snapshot
from trundle.spatial import Twist

from .namespaces import namespace_of, period_of
from .odometry import WIDE, OdometryTopic, true_motion
from .ros_plugin import RosPlugin
from .twist_command import TwistCommand


class PlanarMove(RosPlugin):
    """Gives the model its velocity at every step: it neither falls nor tilts by itself.

    Parameters, with gazebo_ros' defaults: <commandTopic> cmd_vel, <odometryTopic> odom, <odometryFrame> odom,
    <robotBaseFrame> base_footprint, <odometryRate> 20, <cmdTimeout> −1 [s] (none).
    """

    def __init__(self, sim: Simulation, model: ModelHandle, node: Node, tag: PluginTag) -> None:
        parameters, report = tag.node, sim.report
        namespace = namespace_of(tag, model.name)
        self._model = model
        self._command = TwistCommand.of(tag, namespace, node)
        self._timeout_s = parameters.number("cmdTimeout", default=-1.0, report=report)
        self._tell_ns = period_of(parameters.number("odometryRate", default=20.0, report=report))
        self._told_ns = sim.time_ns
        self._odometry = OdometryTopic.of(
            tag, namespace, node, variances=(1e-5, 1e-5, WIDE, WIDE, WIDE, 1e-3), with_tf=True
        )

    def before_step(self, sim: Simulation) -> None:
        """Move."""
        command = self._command
        if 0.0 < self._timeout_s < (sim.time_ns - command.stamp_ns) / 1e9:
            command.stop()
        yaw = self._model.pose.rpy[2]
        cos, sin = math.cos(yaw), math.sin(yaw)
        forward, sideways = command.forward, command.sideways
        linear = (cos * forward - sin * sideways, sin * forward + cos * sideways, 0.0)
        self._model.set_twist(Twist(linear, (0.0, 0.0, command.turning)))

    def after_step(self, snapshot: Snapshot) -> None:
        """Tell where that led, now and then."""
        if snapshot.time_ns < self._told_ns + self._tell_ns and snapshot.time_ns >= self._told_ns:
            return
        self._told_ns = snapshot.time_ns
        self._odometry.publish(snapshot.time_ns, *true_motion(self._model))

    def reset(self) -> None:
        """Stand still."""
        self._command.stop()
