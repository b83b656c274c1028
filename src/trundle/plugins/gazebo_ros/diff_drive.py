"""libgazebo_ros_diff_drive.so: cmd_vel in; wheel speeds, odometry and tf out."""

import math

from trundle.control import DifferentialDrive, WheelOdometry, step_towards
from trundle.model import PluginTag
from trundle.ros import Node, Transform, TransformBroadcaster
from trundle.simulation import JointHandle, ModelHandle, Simulation, Snapshot
from trundle.spatial import Pose, Twist

from .namespaces import join_topic, mark_read, rate_to_period_ns, read_namespace
from .odometry import LARGE_VARIANCE, OdometryTopic, ground_truth
from .ros_plugin import RosPlugin
from .twist_command import TwistCommand

_VARIANCES = (1e-5, 1e-5, LARGE_VARIANCE, LARGE_VARIANCE, LARGE_VARIANCE, 1e-3)


class DiffDrive(RosPlugin):
    """Drives two wheels at the speeds of a commanded body twist.

    Parameters, with gazebo_ros' defaults: <commandTopic> cmd_vel, <odometryTopic> odom, <odometryFrame> odom,
    <robotBaseFrame> base_footprint, <leftJoint> left_joint, <rightJoint> right_joint, <wheelSeparation> 0.34,
    <wheelDiameter> 0.15, <wheelTorque> 5, <wheelAcceleration> 0 (at once), <updateRate> 100, <odometrySource> world or
    encoder, <publishTf> and <publishOdomTF> true, <publishWheelTF> and <publishWheelJointState> false. The
    left wheel turns with v − ω·separation/2; <legacyMode> true mirrors the turn, the default up to Kinetic.
    """

    def __init__(self, sim: Simulation, model: ModelHandle, node: Node, tag: PluginTag) -> None:
        parameters, report = tag.node, sim.report
        self._model = model
        namespace = read_namespace(tag, model.name)

        def number(name: str, default: float) -> float:
            return parameters.number(name, default=default, report=report)

        def flag(name: str, *, default: bool) -> bool:
            return parameters.flag(name, default=default, report=report)

        self._wheels = (
            model.joint(parameters.string("leftJoint", default="left_joint")),
            model.joint(parameters.string("rightJoint", default="right_joint")),
        )
        self._drive = DifferentialDrive(
            separation=number("wheelSeparation", 0.34), wheel_radius=number("wheelDiameter", 0.15) / 2
        )
        self._torque, self._acceleration = number("wheelTorque", 5.0), number("wheelAcceleration", 0.0)
        self._sign = -1.0 if flag("legacyMode", default=node.profile.mirrored_diff_drive) else 1.0
        self.period_ns = rate_to_period_ns(number("updateRate", 100.0))
        self._from_wheels = parameters.string("odometrySource", default="world") in ("encoder", "0")
        self._command = TwistCommand.from_tag(tag, namespace, node)
        self._odometry = None
        if flag("publishTf", default=True):
            with_tf = flag("publishOdomTF", default=True)
            self._odometry = OdometryTopic.from_tag(tag, namespace, node, variances=_VARIANCES, with_tf=with_tf)
        states = flag("publishWheelJointState", default=False)
        self._states = (
            node.advertise(join_topic(namespace, "joint_states"), "sensor_msgs/JointState") if states else None
        )
        self._frames = TransformBroadcaster(node) if flag("publishWheelTF", default=False) else None
        mark_read(parameters, "odometryFrame", "robotBaseFrame", "odometryTopic", "publishOdomTF")
        self.reset()

    def before_step(self, sim: Simulation) -> None:
        """Set both wheels' speeds."""
        most = self._acceleration * (self.period_ns or sim.step_ns) / 1e9
        wanted = self._drive.wheel_speeds(self._command.forward, self._sign * self._command.yaw_rate)
        for number, (wheel, speed) in enumerate(zip(self._wheels, wanted, strict=True)):
            if self._acceleration > 0.0:
                speed = step_towards(self._speeds[number], speed, most / self._drive.wheel_radius)
            self._speeds[number] = speed
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
        if self._frames is not None and self._frames.has_subscribers:
            self._frames.send_transform(*(_frame(self._model, wheel, snapshot.time_ns) for wheel in self._wheels))

    def reset(self) -> None:
        """Stop, and restart odometry at its origin."""
        self._command.stop()
        self._speeds = [0.0, 0.0]
        self._place = WheelOdometry(self._drive)
        self._turned = [wheel.position for wheel in self._wheels]
        self._last_ns = 0

    def _integrate_wheels(self, time_ns: int) -> tuple[Pose, Twist]:
        """Integrate the wheels' rotation; return pose and twist."""
        turned = [wheel.position for wheel in self._wheels]
        left, right = (now - before for now, before in zip(turned, self._turned, strict=True))
        if self._sign < 0.0:
            left, right = right, left
        distance, turn = self._place.update(left, right)
        elapsed, self._turned, self._last_ns = (time_ns - self._last_ns) / 1e9, turned, time_ns
        place = self._place
        pose = Pose((place.x, place.y, 0.0), (math.cos(place.yaw / 2), 0.0, 0.0, math.sin(place.yaw / 2)))
        if elapsed <= 0.0:
            return pose, Twist()
        return pose, Twist((distance / elapsed, 0.0, 0.0), (0.0, 0.0, turn / elapsed))


def _frame(model: ModelHandle, wheel: JointHandle, time_ns: int) -> Transform:
    parent, child = wheel.joint.parent, wheel.joint.child
    pose = model.link(parent).pose.inverse() @ model.link(child).pose
    return Transform(parent=parent, child=child, stamp_ns=time_ns, translation=pose.position, rotation=pose.quaternion)
