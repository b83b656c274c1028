"""libgazebo_ros_tricycle_drive.so: one driven and steered wheel by cmd_vel; odometry and tf out."""

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

_LAG = 2
"""Time constant of the steering, in updates."""


class TricycleDrive(RosPlugin):
    """Drives the wheel at linear.x / radius, and steers it to angular.z, an angle here [rad].

    Parameters, with gazebo_ros' defaults: <steeringJoint> front_steering_joint, <actuatedWheelJoint> front_wheel_joint,
    <encoderWheelLeftJoint> left_wheel_joint, <encoderWheelRightJoint> right_wheel_joint, <actuatedWheelDiameter> and
    <encoderWheelDiameter> 0.15, <encoderWheelSeparation> 0.5, <wheelAcceleration> 0 (at once) and <wheelDeceleration>
    (the same) [rad/s²], <steeringSpeed> 0 (at once) [rad/s], <wheelTorque> 5, <odometrySource> world or encoder,
    <updateRate> 100, <commandTopic>, <odometryTopic>, <odometryFrame>, <robotBaseFrame>, <publishWheelJointState> and
    <publishWheelTF> (frames named by the joints). Encoder odometry turns as the
    robot does; the original's is mirrored.
    """

    def __init__(self, sim: Simulation, model: ModelHandle, node: Node, parameters: TagParameters) -> None:
        names = plugin_names(sim, model, node, parameters)

        self._model = model
        self._steering = model.joint(parameters.text("steeringJoint", "front_steering_joint"))
        self._wheel = model.joint(parameters.text("actuatedWheelJoint", "front_wheel_joint"))
        self._encoders = [
            model.joint(parameters.text(f"encoderWheel{side}Joint", f"{side.lower()}_wheel_joint"))
            for side in ("Left", "Right")
        ]
        self._radius = parameters.number("actuatedWheelDiameter", 0.15) / 2
        self._drive = DifferentialDrive(
            separation=parameters.number("encoderWheelSeparation", 0.5),
            wheel_radius=parameters.number("encoderWheelDiameter", 0.15) / 2,
        )
        self._torque, self._steering_speed = (
            parameters.number("wheelTorque", 5.0),
            parameters.number("steeringSpeed", 0.0),
        )
        self._acceleration = parameters.number("wheelAcceleration", 0.0)
        self._deceleration = parameters.number("wheelDeceleration", self._acceleration)
        self.period_ns = rate_to_period_ns(parameters.number("updateRate", 100.0))
        self._from_wheels = parameters.text("odometrySource", "world") in ("encoder", "0")
        self._command = TwistCommand.from_tag(parameters, names)
        variances = (1e-5, 1e-5, LARGE_VARIANCE, LARGE_VARIANCE, LARGE_VARIANCE, 1e-3)
        self._odometry = OdometryTopic.from_tag(parameters, names, variances=variances, with_tf=True, base="base_link")
        states = parameters.flag("publishWheelJointState", default=False)
        self._states = names.advertise("sensor_msgs/JointState", "joint_states", queue_size=10) if states else None
        self._frames = None
        if parameters.flag("publishWheelTF", default=False):
            joints = (self._steering, self._wheel, *self._encoders)
            self._frames = WheelFrames(names, model, {joint.name: joint for joint in joints})
        parameters.ignore("wheelSpeedTolerance", "steeringAngleTolerance")
        self.reset()

    def before_step(self, sim: Simulation) -> None:
        """Set wheel speed and steering angle."""
        dt_s = (self.period_ns or sim.step_ns) / 1e9
        target = self._command.forward / self._radius
        change = self._acceleration if abs(target) > abs(self._speed) else self._deceleration
        self._speed = step_towards(self._speed, target, change * dt_s) if self._acceleration > 0.0 else target
        self._wheel.command_velocity(self._speed, max_effort=self._torque)
        angle = min(max(self._command.yaw_rate, -math.pi / 2), math.pi / 2)
        if self._steering_speed > 0.0:
            angle = step_towards(self._angle, angle, self._steering_speed * dt_s)
        self._angle = angle
        self._steering.drive_kinematically((angle - self._steering.position) / (_LAG * dt_s))

    def after_step(self, snapshot: Snapshot) -> None:
        """Publish odometry, joint states and wheel frames."""
        pose, twist = self._integrate_wheels(snapshot.time_ns) if self._from_wheels else ground_truth(self._model)
        self._odometry.publish(snapshot.time_ns, pose, twist)
        if self._frames is not None:
            self._frames.send(snapshot.time_ns)
        if self._states is not None and self._states.has_subscribers:
            joints = [self._steering, self._wheel, *self._encoders]
            self._states.publish(
                {
                    "header": {"stamp": snapshot.time_ns},
                    "name": [joint.name for joint in joints],
                    "position": [joint.position for joint in joints],
                    "velocity": [joint.velocity for joint in joints],
                }
            )

    def reset(self) -> None:
        """Stop, steer straight, and restart odometry at its origin."""
        self._command.stop()
        self._speed, self._angle = 0.0, self._steering.position
        self._wheel_odometry = WheelOdometry(self._drive)
        self._last_positions = [wheel.position for wheel in self._encoders]
        self._last_ns = 0

    def _integrate_wheels(self, time_ns: int) -> tuple[Pose, Twist]:
        """Integrate the encoder wheels' rotation; return pose and twist."""
        positions = [wheel.position for wheel in self._encoders]
        left, right = (now - last for now, last in zip(positions, self._last_positions, strict=True))
        distance, turn = self._wheel_odometry.update(left, right)
        elapsed, self._last_positions, self._last_ns = (time_ns - self._last_ns) / 1e9, positions, time_ns
        pose = Pose.from_rpy(self._wheel_odometry.x, self._wheel_odometry.y, 0.0, 0.0, 0.0, self._wheel_odometry.yaw)
        if elapsed <= 0.0:
            return pose, Twist()
        return pose, Twist((distance / elapsed, 0.0, 0.0), (0.0, 0.0, turn / elapsed))
