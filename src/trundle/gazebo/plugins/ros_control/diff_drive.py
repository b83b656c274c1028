"""diff_drive_controller/DiffDriveController: wheel speeds from a body twist; odometry and tf."""

import math
from typing import TYPE_CHECKING, Self

from msgspec.structs import astuple

from trundle.robots.parameters import ParamError, RosParameters
from trundle.sim.control import DiffDriveLaw, DifferentialDrive

from .base_odometry import BaseOdometry
from .controller import ControllerContext, Endpoints, InStepController
from .drive_settings import joint_names, length, origin, speed_limit, wheel_radius
from .transmissions import Interface

if TYPE_CHECKING:
    from trundle.ros.message_types import geometry_msgs

_VELOCITY: Interface = "VelocityJointInterface"
_WINDOW = 10


class DiffDriveController(InStepController):
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
                f"{context.name}: {len(self._left)} left wheels, but {len(self._right)} right ones; use as many of each"
            )
        self.claims: dict[Interface | str, list[str]] = {_VELOCITY: [j.name for j in (*self._left, *self._right)]}
        drive = self._geometry(settings)
        radii = tuple(
            drive.wheel_radius
            * settings.number(f"{side}_wheel_radius_multiplier", settings.number("wheel_radius_multiplier", 1.0))
            for side in ("left", "right")
        )
        limits = (
            speed_limit(settings.section("linear").section("x")),
            speed_limit(settings.section("angular").section("z")),
        )
        self._law = DiffDriveLaw(
            self._left,
            self._right,
            wheel_radius=drive.wheel_radius,
            separation=drive.separation,
            radii=(radii[0], radii[1]),
            limits=[astuple(limit) for limit in limits],
            timeout_ns=round(settings.number("cmd_vel_timeout", 0.5) * 1e9),
            open_loop=settings.flag("open_loop", default=False),
            window=max(1, settings.integer("velocity_rolling_window_size", _WINDOW)),
        )
        self.laws = (self._law,)
        self._advertise(settings)

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
        self._odometry.restart(time_ns)
        self._law.start()

    def due_ns(self, time_ns: int) -> float:
        """Return the time of the next message [ns]."""
        return time_ns if self._limited_has_subscribers else self._odometry.next_ns

    def update(self, time_ns: int, dt: float) -> None:
        """Publish odometry and the limited command."""
        if self._odometry.due(time_ns, dt):
            speeds = self._law.speeds
            linear, angular = (sum(speed[i] for speed in speeds) / max(1, len(speeds)) for i in (0, 1))
            self._odometry.publish(time_ns, self._law.pose, (linear, 0.0, angular))
        if self._limited_topic is not None and self._limited_has_subscribers:
            linear, angular = self._law.limited
            header = {"stamp": time_ns, "frame_id": self._odometry.base}
            twist = {"linear": {"x": linear}, "angular": {"z": angular}}
            self._limited_topic.publish({"header": header, "twist": twist})

    @property
    def _limited_has_subscribers(self) -> bool:
        return self._limited_topic is not None and self._limited_topic.has_subscribers

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
            self._law.set_command(stamp, float(message.linear.x), float(message.angular.z))
        else:
            self._context.node.log.warn("Received NaN in velocity command. Ignoring.")

    def _geometry(self, settings: RosParameters) -> DifferentialDrive:
        """Return the geometry from the parameters, else from the model."""
        context, left, right = self._context, self._left[0], self._right[0]
        separation = length(context, "wheel_separation", math.dist(origin(context, left), origin(context, right)))
        return DifferentialDrive(
            wheel_radius=wheel_radius(context, left),
            separation=separation * settings.number("wheel_separation_multiplier", 1.0),
        )
