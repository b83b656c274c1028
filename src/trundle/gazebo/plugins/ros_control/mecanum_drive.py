"""mecanum_drive_controller/MecanumDriveController: wheel speeds from a twist in the plane; odometry and tf."""

import math
from typing import TYPE_CHECKING, Self

from trundle.sim.control import MecanumDrive

from .base_odometry import BaseOdometry
from .controller import ControllerContext, Endpoints
from .drive_settings import length, origin, speed_limit, wheel_radius
from .transmissions import Interface

if TYPE_CHECKING:
    from trundle.ros.message_types import geometry_msgs

_VELOCITY: Interface = "VelocityJointInterface"
_WHEELS = ("front_left", "front_right", "back_left", "back_right")


class MecanumDriveController:
    """Drives four mecanum wheels by `~cmd_vel`: linear.x, linear.y and angular.z.

    Parameters, with the original's defaults: front_left_, front_right_, back_left_ and back_right_wheel_joint (that
    name), wheel_separation_x and wheel_separation_y (between axles, and wheels of an axle) and wheel_radius (those of
    the model), wheel_separation_multiplier and wheel_radius_multiplier 1, publish_rate 50, cmd_vel_timeout 0.5,
    base_frame_id base_link, enable_odom_tf true, linear/x, linear/y and angular/z with has_, max_ and min_
    velocity_limits and acceleration_limits, pose_ and twist_covariance_diagonal. Odometry is in the frame odom.
    """

    def __init__(self, context: ControllerContext) -> None:
        settings = context.settings
        self._node = context.node
        names = [settings.text(f"{wheel}_wheel_joint", f"{wheel}_wheel_joint") for wheel in _WHEELS]
        self._wheels = [context.joint(name, _VELOCITY) for name in names]
        self.claims: dict[Interface | str, list[str]] = {_VELOCITY: names}
        self._law = self._geometry(context)
        self._timeout_ns = round(settings.number("cmd_vel_timeout", 0.5) * 1e9)
        linear = settings.section("linear")
        sections = (linear.section("x"), linear.section("y"), settings.section("angular").section("z"))
        self._limits = tuple(map(speed_limit, sections))
        self._endpoints = Endpoints()
        self._odometry = BaseOdometry(context, self._endpoints, frame="odom")
        self._endpoints.add(
            context.node.subscribe(f"{context.name}/cmd_vel", "geometry_msgs/Twist", self._on_command, queue_size=1)
        )
        self._is_running = False
        self._pose = (0.0, 0.0, 0.0)
        """x, y [m] and yaw [rad]."""
        self._history = [(0.0, 0.0)] * 3
        """(last, last but one) command: forward, left, turning."""
        self._command: tuple[int, tuple[float, float, float]] = (0, (0.0, 0.0, 0.0))
        """Stamp [ns] and twist."""

    @classmethod
    def create(cls, context: ControllerContext) -> Self:
        """See `Controller.create`."""
        return cls(context)

    def start(self, time_ns: int) -> None:
        """Stop, and restart the odometry's period."""
        for joint in self._wheels:
            joint.start()
        self._odometry.restart(time_ns)
        self._command = (0, (0.0, 0.0, 0.0))
        self._is_running = True

    def update(self, time_ns: int, dt: float) -> None:
        """Update and publish odometry, and write the limited command."""
        front_left, front_right, rear_left, rear_right = (joint.velocity for joint in self._wheels)
        twist = forward, left, yaw_rate = self._law.twist((front_left, front_right, rear_left, rear_right))
        x, y, yaw = self._pose
        mid_yaw = yaw + yaw_rate * dt / 2
        cos, sin = math.cos(mid_yaw), math.sin(mid_yaw)
        self._pose = (x + (forward * cos - left * sin) * dt, y + (forward * sin + left * cos) * dt, yaw + yaw_rate * dt)
        if self._odometry.due(time_ns, dt):
            self._odometry.publish(time_ns, self._pose, twist)
        stamp, command = self._command
        targets = command if time_ns - stamp <= self._timeout_ns else (0.0, 0.0, 0.0)
        for index, target in enumerate(targets):
            last, previous = self._history[index]
            self._history[index] = (self._limits[index].limit(target, last, previous, dt), last)
        (forward, _), (left, _), (yaw_rate, _) = self._history
        for joint, speed in zip(self._wheels, self._law.wheel_speeds(forward, left, yaw_rate), strict=True):
            joint.command = speed

    def stop(self) -> None:
        """Brake."""
        self._is_running = False
        for joint in self._wheels:
            joint.stop()

    def close(self) -> None:
        """Unregister its topics."""
        self._endpoints.close()

    def _on_command(self, message: "geometry_msgs.Twist") -> None:
        twist = (float(message.linear.x), float(message.linear.y), float(message.angular.z))
        if not self._is_running:
            self._node.log.error("Can't accept new commands. Controller is not running.")
        elif all(map(math.isfinite, twist)):
            self._command = (self._node.clock.now_ns(), twist)
        else:
            self._node.log.warn("Received NaN in velocity command. Ignoring.")

    def _geometry(self, context: ControllerContext) -> MecanumDrive:
        """Return the geometry from the parameters, else from the model."""
        settings = context.settings
        front_left, front_right, rear_left, _ = (origin(context, wheel) for wheel in self._wheels)
        length_x = length(context, "wheel_separation_x", abs(front_left[0] - rear_left[0]) or None)
        length_y = length(context, "wheel_separation_y", abs(front_left[1] - front_right[1]) or None)
        return MecanumDrive(
            radius=wheel_radius(context, self._wheels[0]) * settings.number("wheel_radius_multiplier", 1.0, above=0.0),
            reach=(length_x + length_y) / 2 * settings.number("wheel_separation_multiplier", 1.0, above=0.0),
        )
