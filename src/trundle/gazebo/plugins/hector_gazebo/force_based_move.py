"""libgazebo_ros_force_based_move.so: velocity control of a model by forces."""

import math

from trundle.robots.parameters import TagParameters
from trundle.ros import Node
from trundle.sim.simulation import ModelHandle, Simulation, Snapshot
from trundle.spatial import Pose, Twist, Wrench

from ..gazebo_ros.namespaces import rate_to_period_ns
from ..gazebo_ros.odometry import LARGE_VARIANCE, OdometryTopic
from ..gazebo_ros.ros_plugin import RosPlugin, plugin_names
from ..gazebo_ros.twist_command import TwistCommand

_VARIANCES = (1e-3, 1e-3, LARGE_VARIANCE, LARGE_VARIANCE, LARGE_VARIANCE, 1e-2)
_TWIST_VARIANCES = (1e-3, 1e-3, 1e-3, LARGE_VARIANCE, LARGE_VARIANCE, 1e-2)
_TURNING_VARIANCE = 100.0
"""Variance of yaw while the model turns [rad²]."""
_MIN_YAW_RATE = 1e-4
"""Yaw rate [rad/s] below which motion is straight."""


class ForceBasedMove(RosPlugin):
    """Applies gain · (commanded − measured velocity) along x and y, and about z, to <robotBaseFrame>.

    Parameters, with hector_gazebo's defaults: <commandTopic> cmd_vel, <odometryTopic> odom, <odometryFrame> odom,
    <robotBaseFrame> base_footprint, <odometryRate> 20, <publishOdometryTf> true, <x_velocity_p_gain> and
    <y_velocity_p_gain> 10000 [N·s/m], <yaw_velocity_p_gain> 100 [N·m·s/rad]. Odometry starts at zero and integrates the
    model's velocities at the times of its messages.
    """

    SIDEWAYS = True
    """True if odometry includes sideways motion."""

    def __init__(self, sim: Simulation, model: ModelHandle, node: Node, parameters: TagParameters) -> None:
        names = plugin_names(sim, model, node, parameters)

        self.model = model
        self.command = TwistCommand.from_tag(parameters, names)
        self._link = model.link(parameters.text("robotBaseFrame", "base_footprint"))
        self._gains = parameters.number("x_velocity_p_gain", 1e4), parameters.number("y_velocity_p_gain", 1e4)
        self._yaw_gain = parameters.number("yaw_velocity_p_gain", 100.0)
        rate_hz = parameters.number("odometryRate", 20.0)
        self._period_ns = rate_to_period_ns(rate_hz) if rate_hz > 0.0 else None
        self._odometry = OdometryTopic.from_tag(
            parameters,
            names,
            variances=_VARIANCES,
            twist_variances=_TWIST_VARIANCES,
            with_tf=parameters.flag("publishOdometryTf", default=True),
        )
        self._published_ns: int | None = None
        self._odometry_pose = Pose()

    def before_step(self, sim: Simulation) -> None:
        """Apply the force and torque."""
        del sim
        twist = self.model.twist
        vx, vy, _ = self.model.pose.inverse().transform_vector(twist.linear)
        x_gain, y_gain = self._gains
        force = (x_gain * (self.command.forward - vx), y_gain * (self.command.sideways - vy), 0.0)
        torque = (0.0, 0.0, self._yaw_gain * (self.command.yaw_rate - twist.angular[2]))
        self._link.add_wrench(Wrench(self._link.pose.transform_vector(force), torque))

    def after_step(self, snapshot: Snapshot) -> None:
        """Publish odometry at its rate."""
        if self._published_ns is None:
            self._published_ns = snapshot.time_ns
        elapsed_ns = snapshot.time_ns - self._published_ns
        if self._period_ns is None or elapsed_ns <= self._period_ns:
            return
        elapsed_s, self._published_ns = elapsed_ns / 1e9, snapshot.time_ns
        body_from_world = self.model.pose.inverse()
        vx, vy, _ = body_from_world.transform_vector(self.model.twist.linear)
        rate = body_from_world.transform_vector(self.model.twist.angular)[2]
        vy = vy if self.SIDEWAYS else 0.0
        self._odometry_pose = self._odometry_pose @ _arc(
            vx * elapsed_s, vy * elapsed_s, rate * elapsed_s if _is_turning(rate) else 0.0
        )
        twist = Twist((vx, vy, 0.0), (0.0, 0.0, rate))
        yaw_variance = _TURNING_VARIANCE if _is_turning(rate) else None
        self._odometry.publish(snapshot.time_ns, self._odometry_pose, twist, yaw_variance=yaw_variance)

    def reset(self) -> None:
        """Set the command to zero, and restart odometry at its origin."""
        self.command.stop()
        self._published_ns, self._odometry_pose = None, Pose()


def _is_turning(rate: float) -> bool:
    return abs(rate) >= _MIN_YAW_RATE


def _arc(forward: float, sideways: float, turn: float) -> Pose:
    """Return the pose after a constant body twist over displacements [m, m, rad]."""
    along = math.sin(turn) / turn if turn else 1.0
    across = (1.0 - math.cos(turn)) / turn if turn else 0.0
    x, y = along * forward - across * sideways, across * forward + along * sideways
    return Pose.from_rpy(x, y, 0.0, yaw=turn)
