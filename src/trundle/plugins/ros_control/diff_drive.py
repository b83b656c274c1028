"""diff_drive_controller/DiffDriveController: wheel speeds from a body twist; odometry and tf."""

import math
from collections import deque
from typing import TYPE_CHECKING, Self

from trundle.control import DifferentialDrive, WheelOdometry
from trundle.parameters import ParamError, RosParameters

from .base_odometry import BaseOdometry
from .controller import ControllerContext, Endpoints
from .drive_settings import joint_names, length, origin, speed_limit, wheel_radius
from .transmissions import Interface

if TYPE_CHECKING:
    from trundle.ros.message_types import geometry_msgs

_VELOCITY: Interface = "VelocityJointInterface"
_WINDOW = 10


class DiffDriveController:
    """Differential drive of two wheels, or two rows of wheels.

    Parameters, with the original's defaults: left_wheel, right_wheel (a joint or several; required), wheel_separation
    and wheel_radius (those of the model), wheel_separation_multiplier, left_ and right_wheel_radius_multiplier 1,
    publish_rate 50, cmd_vel_timeout 0.5, open_loop false, base_frame_id base_link, odom_frame_id odom, enable_odom_tf
    true, velocity_rolling_window_size 10, linear/x and angular/z with has_, max_ and min_ velocity_limits,
    acceleration_limits and jerk_limits, pose_ and twist_covariance_diagonal, publish_cmd false.
    """

    def __init__(self, context: ControllerContext) -> None:
        settings = context.settings
        self._context = context
        self._left = [context.joint(name, _VELOCITY) for name in joint_names(settings, "left_wheel")]
        self._right = [context.joint(name, _VELOCITY) for name in joint_names(settings, "right_wheel")]
        if len(self._left) != len(self._right):
            raise ParamError(
                f"{context.name}: {len(self._left)} left wheels, but {len(self._right)} right ones; as many are needed"
            )
        self.claims: dict[Interface | str, list[str]] = {_VELOCITY: [j.name for j in (*self._left, *self._right)]}
        self._drive = self._geometry(settings)
        self._radii = tuple(
            self._drive.wheel_radius
            * settings.number(f"{side}_wheel_radius_multiplier", settings.number("wheel_radius_multiplier", 1.0))
            for side in ("left", "right")
        )
        self._timeout_ns = round(settings.number("cmd_vel_timeout", 0.5) * 1e9)
        self._open_loop = settings.flag("open_loop", default=False)
        self._limits = (
            speed_limit(settings.section("linear").section("x")),
            speed_limit(settings.section("angular").section("z")),
        )
        self._window = max(1, settings.integer("velocity_rolling_window_size", _WINDOW))
        self._advertise(settings)
        self._clear()

    def _advertise(self, settings: RosParameters) -> None:
        context = self._context
        self._endpoints = Endpoints()
        self._odometry = BaseOdometry(context, self._endpoints, frame=settings.text("odom_frame_id", "odom"))
        self._endpoints.add(
            context.node.subscribe(f"{context.name}/cmd_vel", "geometry_msgs/Twist", self._on_command, queue_size=1)
        )
        self._limited_topic = None
        if settings.flag("publish_cmd", default=False):
            self._limited_topic = context.node.advertise(
                f"{context.name}/cmd_vel_out", "geometry_msgs/TwistStamped", queue_size=100
            )
            self._endpoints.add(self._limited_topic)

    @classmethod
    def create(cls, context: ControllerContext) -> Self:
        """See `Controller.create`."""
        return cls(context)

    def start(self, time_ns: int) -> None:
        """Stop, and integrate odometry from the current wheel positions."""
        for joint in (*self._left, *self._right):
            joint.start()
        self._odometry.restart(time_ns)
        self._wheel_angles = self._turns()
        self._command = None

    def update(self, time_ns: int, dt: float) -> None:
        """Update and publish odometry, and write the limited command."""
        self._count(dt)
        if self._odometry.due(time_ns):
            self._publish(time_ns)
        linear, angular = self._current_command(time_ns)
        for number, wanted in enumerate((linear, angular)):
            last, before = self._history[number]
            limited = self._limits[number].limit(wanted, last, before, dt)
            self._history[number] = (limited, last)
        (linear, _), (angular, _) = self._history
        if self._limited_topic is not None and self._limited_topic.has_subscribers:
            header = {"stamp": time_ns, "frame_id": self._odometry.base}
            twist = {"linear": {"x": linear}, "angular": {"z": angular}}
            self._limited_topic.publish({"header": header, "twist": twist})
        half = angular * self._drive.separation / 2
        for joints, speed, radius in zip(
            (self._left, self._right), (linear - half, linear + half), self._radii, strict=True
        ):
            for joint in joints:
                joint.command = speed / radius

    def stop(self) -> None:
        """Brake."""
        for joint in (*self._left, *self._right):
            joint.stop()

    def close(self) -> None:
        """Unregister its topics."""
        self._endpoints.close()

    def _on_command(self, message: "geometry_msgs.Twist") -> None:
        if math.isfinite(message.linear.x) and math.isfinite(message.angular.z):
            stamp = self._context.node.clock.now_ns()
            self._command = (stamp, float(message.linear.x), float(message.angular.z))
        else:
            self._context.node.log.warn("Received NaN in velocity command. Ignoring.")

    def _current_command(self, time_ns: int) -> tuple[float, float]:
        """Last command, or zero if it has timed out."""
        if self._command is None or time_ns - self._command[0] > self._timeout_ns:
            return 0.0, 0.0
        return self._command[1:]

    def _clear(self) -> None:
        self._command: tuple[int, float, float] | None = None
        self._history = [(0.0, 0.0), (0.0, 0.0)]
        """(last, last but one) command: linear, angular."""
        self._place = WheelOdometry(self._drive)
        self._wheel_angles = (0.0, 0.0)
        self._speeds: deque[tuple[float, float]] = deque(maxlen=self._window)

    def _turns(self) -> tuple[float, float]:
        left, right = (sum(joint.position for joint in side) / len(side) for side in (self._left, self._right))
        return left, right

    def _count(self, dt: float) -> None:
        if self._open_loop:
            (linear, _), (angular, _) = self._history
            half = angular * self._drive.separation / 2
            left, right = (linear - half) * dt, (linear + half) * dt
        else:
            now = self._turns()
            left, right = (
                (new - old) * radius for new, old, radius in zip(now, self._wheel_angles, self._radii, strict=True)
            )
            self._wheel_angles = now
        radius = self._drive.wheel_radius
        distance, turn = self._place.update(left / radius, right / radius)
        if dt > 0.0:
            self._speeds.append((distance / dt, turn / dt))

    def _publish(self, time_ns: int) -> None:
        place, count = self._place, max(1, len(self._speeds))
        linear, angular = (sum(speed[i] for speed in self._speeds) / count for i in (0, 1))
        self._odometry.publish(time_ns, (place.x, place.y, place.yaw), (linear, 0.0, angular))

    def _geometry(self, settings: RosParameters) -> DifferentialDrive:
        """Geometry by the parameters, else from the model."""
        context, left, right = self._context, self._left[0], self._right[0]
        separation = length(context, "wheel_separation", math.dist(origin(context, left), origin(context, right)))
        return DifferentialDrive(
            wheel_radius=wheel_radius(context, left),
            separation=separation * settings.number("wheel_separation_multiplier", 1.0),
        )
