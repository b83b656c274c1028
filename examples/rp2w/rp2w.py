"""Drives the RP2W telepresence robot: replaces `librp2w.so`, and is an example of a plugin.

Copy this file next to your model.sdf; the model's <plugin filename="…/librp2w.so"> then loads it.

    /cmd_vel       geometry_msgs/Twist     linear.x [m/s] forwards, angular.z [rad/s] to the left
    /camera/pan    std_msgs/Float64        angle of the camera base [rad], positive to the left
    /camera/tilt   std_msgs/Float64        angle of the camera's tilt [rad], positive is up
    /odom          nav_msgs/Odometry       from the wheels; also tf world → odom → base_footprint
    /joint_states  sensor_msgs/JointState  every joint

Forward is the model's +y, the direction of both cameras. Parameters of <plugin>, all optional:
<wheel_radius> 0.0635 m, <wheel_separation> 0.3048 m, <max_torque> 2 N·m for each wheel, <acceleration> 0.5 m/s²,
<frame> base_footprint. The pole, 1.4 m high, tips over at higher accelerations.
"""

import math

from trundle import ModelHandle, Plugin, PluginTag, Simulation, Snapshot, TagParameters, ros
from trundle.ros import bridge
from trundle.sim.control import DifferentialDrive, WheelOdometry, step_towards

PERIOD_S = 0.02
TURNING_ACCELERATION = 2.0
"""[rad/s²]"""
CAMERA_TORQUE = 5.0
"""[N·m]"""


class Rp2w(Plugin):
    """Two driven wheels and a pan-tilt camera."""

    period_ns = round(PERIOD_S * 1e9)

    def __init__(self, sim: Simulation, model: ModelHandle, node: "ros.Node | None", tag: PluginTag) -> None:
        parameters = TagParameters(tag.node, sim.report)
        self.drive = DifferentialDrive(
            wheel_radius=parameters.number("wheel_radius", 0.0635, above=0.0),
            separation=parameters.number("wheel_separation", 0.3048, above=0.0),
        )
        self.max_torque = parameters.number("max_torque", 2.0)
        self.acceleration = parameters.number("acceleration", 0.5)
        self.frame = parameters.text("frame", "base_footprint")
        parameters.report_unread()
        self.left = model.joint("chassis_left_wheel")
        self.right = model.joint("chassis_right_wheel")
        self.pan = model.joint("body_camera_base")
        self.tilt = model.joint("camera_base_camera")
        self.node = node
        self.reset()
        if node is not None:
            self.join(node, sim, model)

    @classmethod
    def load(cls, sim: Simulation, model: ModelHandle, node: "ros.Node | None", tag: PluginTag) -> "Rp2w":
        return cls(sim, model, node, tag)

    def reset(self) -> None:
        self.command = (0.0, 0.0)
        self.speed = self.turning = 0.0
        self.odometry = WheelOdometry(self.drive)
        self.wheel_positions = (self.left.position, self.right.position)
        self.look(self.pan, 0.0)
        self.look(self.tilt, 0.0)

    def join(self, node: "ros.Node", sim: Simulation, model: ModelHandle) -> None:
        """Advertise and subscribe; callbacks run between two steps."""
        self.odom = node.advertise("/odom", "nav_msgs/Odometry", queue_size=5)
        self.tf = ros.TransformBroadcaster(node)
        x_forward = (math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5))
        ros.StaticTransformBroadcaster(node).send_transform(
            ros.Transform(parent="world", child="odom", rotation=x_forward)
        )
        states = bridge.JointStatesTopic(node, model)
        sim.add_hook(states, period_ns=states.period_ns, enabled=states.enabled)
        node.subscribe("/cmd_vel", "geometry_msgs/Twist", self.take)
        node.subscribe("/camera/pan", "std_msgs/Float64", lambda message: self.look(self.pan, message.data))
        # The tilt joint's axis is the model's +x, to the right: positive angles look up.
        node.subscribe("/camera/tilt", "std_msgs/Float64", lambda message: self.look(self.tilt, message.data))

    def take(self, twist) -> None:
        if math.isfinite(twist.linear.x) and math.isfinite(twist.angular.z):
            self.command = (twist.linear.x, twist.angular.z)

    def look(self, joint, angle: float) -> None:
        if math.isfinite(angle):
            joint.command_position(angle, max_effort=CAMERA_TORQUE)

    def before_step(self, _sim: Simulation) -> None:
        forward, turning = self.command
        self.speed = step_towards(self.speed, forward, self.acceleration * PERIOD_S)
        self.turning = step_towards(self.turning, turning, TURNING_ACCELERATION * PERIOD_S)
        left, right = self.drive.wheel_speeds(self.speed, self.turning)
        # Both wheels' axes point to the right (+x): driving forwards (+y) rotates them in the negative direction.
        self.left.command_velocity(-left, max_effort=self.max_torque)
        self.right.command_velocity(-right, max_effort=self.max_torque)

    def after_step(self, snapshot: Snapshot) -> None:
        before, self.wheel_positions = self.wheel_positions, (self.left.position, self.right.position)
        left, right = (old - new for new, old in zip(self.wheel_positions, before, strict=True))
        distance, turn = self.odometry.update(left, right)
        if self.node is not None:
            self.publish(snapshot.time_ns, distance / PERIOD_S, turn / PERIOD_S)

    def publish(self, time_ns: int, speed: float, turning: float) -> None:
        odometry = self.odometry
        qw, qz = math.cos(odometry.yaw / 2), math.sin(odometry.yaw / 2)
        self.tf.send_transform(
            ros.Transform(
                parent="odom",
                child=self.frame,
                stamp_ns=time_ns,
                translation=(odometry.x, odometry.y, 0.0),
                rotation=(qw, 0.0, 0.0, qz),
            )
        )
        if self.odom.has_subscribers:
            position, orientation = {"x": odometry.x, "y": odometry.y}, {"z": qz, "w": qw}
            self.odom.publish(
                {
                    "header": {"stamp": time_ns, "frame_id": "odom"},
                    "child_frame_id": self.frame,
                    "pose": {"pose": {"position": position, "orientation": orientation}},
                    "twist": {"twist": {"linear": {"x": speed}, "angular": {"z": turning}}},
                }
            )
