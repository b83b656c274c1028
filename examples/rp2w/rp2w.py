"""Drives the RP2W telepresence robot: the plugin that `librp2w.so` was, and the worked example of a plugin.

Copy this file beside your own model.sdf; the model's <plugin filename="…/librp2w.so"> then loads it.

    /cmd_vel       geometry_msgs/Twist     linear.x [m/s] forwards, angular.z [rad/s] to the left
    /camera/pan    std_msgs/Float64        where the camera base turns to [rad], positive to the left
    /camera/tilt   std_msgs/Float64        where the camera tilts to [rad], positive is up
    /odom          nav_msgs/Odometry       from the wheels; also tf world → odom → base_footprint
    /joint_states  sensor_msgs/JointState  every joint

Forward is the model's +y, where both cameras look. Parameters, all optional, inside <plugin>:
<wheel_radius> 0.0635, <wheel_separation> 0.3048, <max_torque> 10, <frame> base_footprint.
"""

import math
from dataclasses import dataclass

from trundle.bridge import JointStates
from trundle.model import PluginTag
from trundle.plugins import Plugin
from trundle.ros import Node, StaticTransformBroadcaster, Transform, TransformBroadcaster
from trundle.simulation import ModelHandle, Simulation, Snapshot

PERIOD_S = 0.02


@dataclass
class Odometry:
    """Where the wheels say the robot is: x forward from where it started, y to the left [m], yaw [rad]."""

    x: float = 0.0
    y: float = 0.0
    yaw: float = 0.0
    forward: float = 0.0
    """[m/s]"""
    turning: float = 0.0
    """[rad/s]"""

    def roll(self, left: float, right: float, separation: float) -> None:
        """Add one period in which the wheels rolled so far over the ground [m]."""
        distance, turn = (left + right) / 2, (right - left) / separation
        self.x += distance * math.cos(self.yaw + turn / 2)
        self.y += distance * math.sin(self.yaw + turn / 2)
        self.yaw += turn
        self.forward, self.turning = distance / PERIOD_S, turn / PERIOD_S


class Rp2w(Plugin):
    """Two driven wheels, a camera that pans and tilts."""

    period_ns = round(PERIOD_S * 1e9)

    def __init__(self, sim: Simulation, model: ModelHandle, tag: PluginTag) -> None:
        report = sim.report
        self.radius = tag.node.number("wheel_radius", default=0.0635, report=report)
        self.separation = tag.node.number("wheel_separation", default=0.3048, report=report)
        self.max_torque = tag.node.number("max_torque", default=10.0, report=report)
        self.frame = tag.node.string("frame", default="base_footprint")
        tag.node.report_unread(report)
        self.left = model.joint("chassis_left_wheel")
        self.right = model.joint("chassis_right_wheel")
        self.pan = model.joint("body_camera_base")
        self.tilt = model.joint("camera_base_camera")
        self.reset()

    @classmethod
    def load(cls, sim: Simulation, model: ModelHandle, node: Node | None, tag: PluginTag) -> "Rp2w":
        plugin = cls(sim, model, tag)
        if node is not None:
            plugin.join(node, sim, model)
        return plugin

    def reset(self) -> None:
        self.forward = self.turning = 0.0
        self.odometry = Odometry()
        self.rolled = (self.left.position, self.right.position)
        self.pan.hold(0.0, max_effort=self.max_torque)
        self.tilt.hold(0.0, max_effort=self.max_torque)

    def join(self, node: Node, sim: Simulation, model: ModelHandle) -> None:
        """Speak and listen on the ROS graph; callbacks run between two steps."""
        self.node = node
        self.odom = node.advertise("/odom", "nav_msgs/Odometry", queue_size=5)
        self.tf = TransformBroadcaster(node)
        StaticTransformBroadcaster(node).send(
            Transform(parent="world", child="odom", rotation=(math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5)))
        )
        sim.add_hook(JointStates(node, model), period_ns=JointStates.period_ns)
        node.subscribe("/cmd_vel", "geometry_msgs/Twist", self.drive)
        node.subscribe("/camera/pan", "std_msgs/Float64", lambda m: self.pan.hold(m.data, max_effort=self.max_torque))
        # The tilt joint's axis is the model's +x, to the right: turning about it lifts the view.
        node.subscribe("/camera/tilt", "std_msgs/Float64", lambda m: self.tilt.hold(m.data, max_effort=self.max_torque))

    def drive(self, twist) -> None:
        self.forward, self.turning = twist.linear.x, twist.angular.z

    def before_step(self, _sim: Simulation) -> None:
        for wheel, speed in (
            (self.left, self.forward - self.turning * self.separation / 2),
            (self.right, self.forward + self.turning * self.separation / 2),
        ):
            # Both wheels' axes point to the right (+x): rolling forwards (+y) turns them the negative way.
            wheel.set_velocity(-speed / self.radius, max_effort=self.max_torque)

    def after_step(self, snapshot: Snapshot) -> None:
        rolled = (self.left.position, self.right.position)
        left, right = (-(now - then) * self.radius for now, then in zip(rolled, self.rolled, strict=True))
        self.rolled = rolled
        self.odometry.roll(left, right, self.separation)
        if hasattr(self, "node"):
            self.publish(snapshot.time_ns)

    def publish(self, time_ns: int) -> None:
        o = self.odometry
        qw, qz = math.cos(o.yaw / 2), math.sin(o.yaw / 2)
        self.tf.send(
            Transform(
                parent="odom",
                child=self.frame,
                stamp_ns=time_ns,
                translation=(o.x, o.y, 0.0),
                rotation=(qw, 0.0, 0.0, qz),
            )
        )
        self.odom.publish(
            self.node.new(
                "nav_msgs/Odometry",
                {
                    "header": {"stamp": self.node.stamp(), "frame_id": "odom"},
                    "child_frame_id": self.frame,
                    "pose": {"pose": {"position": {"x": o.x, "y": o.y}, "orientation": {"z": qz, "w": qw}}},
                    "twist": {"twist": {"linear": {"x": o.forward}, "angular": {"z": o.turning}}},
                },
            )
        )
