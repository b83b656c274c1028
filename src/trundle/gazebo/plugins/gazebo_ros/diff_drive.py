"""libgazebo_ros_diff_drive.so: cmd_vel in; wheel speeds, odometry and tf out."""

import math

from trundle.robots.parameters import TagParameters
from trundle.ros import Node
from trundle.sim.control import DifferentialDrive, WheelOdometry, step_towards
from trundle.sim.simulation import ModelHandle, Simulation, Snapshot
from trundle.spatial import Pose, Twist

from .namespaces import rate_to_period_ns
from .odometry import LARGE_VARIANCE, OdometryTopic, ground_truth
from .ros_plugin import RosPlugin, plugin_names
from .twist_command import TwistCommand
from .wheel_frames import WheelFrames

_VARIANCES = (1e-5, 1e-5, LARGE_VARIANCE, LARGE_VARIANCE, LARGE_VARIANCE, 1e-3)


class DiffDrive(RosPlugin):
    """Drives two wheels at the speeds of a commanded body twist.

    Parameters, with gazebo_ros' defaults: <commandTopic> cmd_vel, <odometryTopic> odom, <odometryFrame> odom,
    <robotBaseFrame> base_footprint, <leftJoint> left_joint, <rightJoint> right_joint, <wheelSeparation> 0.34,
    <wheelDiameter> 0.15, <wheelTorque> 5, <wheelAcceleration> 0 (at once), <updateRate> 100, <odometrySource> world or
    encoder, <publishTf> and <publishOdomTF> true, <publishWheelTF> and <publishWheelJointState> false. The
    left wheel turns with v − ω·separation/2; <legacyMode> true mirrors the turn, the default up to Kinetic.
    """

    def __init__(self, sim: Simulation, model: ModelHandle, node: Node, parameters: TagParameters) -> None:
        self._model = model
        names = plugin_names(sim, model, node, parameters)

        self._wheels = (
            model.joint(parameters.text("leftJoint", "left_joint")),
            model.joint(parameters.text("rightJoint", "right_joint")),
        )
        self._drive = DifferentialDrive(
            separation=parameters.number("wheelSeparation", 0.34),
            wheel_radius=parameters.number("wheelDiameter", 0.15) / 2,
        )
        self._torque, self._acceleration = (
            parameters.number("wheelTorque", 5.0),
            parameters.number("wheelAcceleration", 0.0),
        )
        self._sign = -1.0 if parameters.flag("legacyMode", default=node.profile.mirrored_diff_drive) else 1.0
        self.period_ns = rate_to_period_ns(parameters.number("updateRate", 100.0))
        self._from_wheels = parameters.text("odometrySource", "world") in ("encoder", "0")
        self._command = TwistCommand.from_tag(parameters, names)
        self._odometry = None
        if parameters.flag("publishTf", default=True):
            with_tf = parameters.flag("publishOdomTF", default=True)
            self._odometry = OdometryTopic.from_tag(parameters, names, variances=_VARIANCES, with_tf=with_tf)
        states = parameters.flag("publishWheelJointState", default=False)
        self._states = names.advertise("sensor_msgs/JointState", "joint_states", queue_size=10) if states else None
        self._frames = None
        if parameters.flag("publishWheelTF", default=False):
            self._frames = WheelFrames(names, model, {wheel.joint.child: wheel for wheel in self._wheels})
        parameters.ignore("odometryFrame", "robotBaseFrame", "odometryTopic", "publishOdomTF")
        self.reset()

    def before_step(self, sim: Simulation) -> None:
        """Set both wheels' speeds."""
        max_change = self._acceleration * (self.period_ns or sim.step_ns) / 1e9
        targets = self._drive.wheel_speeds(self._command.forward, self._sign * self._command.yaw_rate)
        for index, (wheel, speed) in enumerate(zip(self._wheels, targets, strict=True)):
            if self._acceleration > 0.0:
                speed = step_towards(self._speeds[index], speed, max_change / self._drive.wheel_radius)
            self._speeds[index] = speed
            wheel.command_velocity(speed, max_effort=self._torque)

    def after_step(self, snapshot: Snapshot) -> None:
        """Publish odometry, joint states and wheel frames."""
        if self._odometry is not None:
            pose, twist = self._integrate_wheels(snapshot.time_ns) if self._from_wheels else ground_truth(self._model)
            self._odometry.publish(snapshot.time_ns, pose, twist)
        if self._states is not None and self._states.has_subscribers:
            header = {"stamp": snapshot.time_ns}
            names, positions = [w.name for w in self._wheels], [w.position for w in self._wheels]
            self._states.publish({"header": header, "name": names, "position": positions})
        if self._frames is not None:
            self._frames.send(snapshot.time_ns)

    def reset(self) -> None:
        """Stop, and restart odometry at its origin."""
        self._command.stop()
        self._speeds = [0.0, 0.0]
        self._wheel_odometry = WheelOdometry(self._drive)
        self._last_positions = [wheel.position for wheel in self._wheels]
        self._last_ns = 0

    def _integrate_wheels(self, time_ns: int) -> tuple[Pose, Twist]:
        """Integrate the wheels' rotation; return pose and twist."""
        positions = [wheel.position for wheel in self._wheels]
        left, right = (now - last for now, last in zip(positions, self._last_positions, strict=True))
        if self._sign < 0.0:
            left, right = right, left
        distance, turn = self._wheel_odometry.update(left, right)
        elapsed, self._last_positions, self._last_ns = (time_ns - self._last_ns) / 1e9, positions, time_ns
        odometry = self._wheel_odometry
        pose = Pose((odometry.x, odometry.y, 0.0), (math.cos(odometry.yaw / 2), 0.0, 0.0, math.sin(odometry.yaw / 2)))
        if elapsed <= 0.0:
            return pose, Twist()
        return pose, Twist((distance / elapsed, 0.0, 0.0), (0.0, 0.0, turn / elapsed))
