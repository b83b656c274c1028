"""ackermann_steering_controller/AckermannSteeringController: one driven rear wheel, one steered front wheel."""

import math
from collections import deque
from typing import TYPE_CHECKING, Self

from .base_odometry import BaseOdometry
from .controller import ControllerContext, Endpoints
from .drive_settings import length, origin, speed_limit, wheel_radius
from .transmissions import Interface

if TYPE_CHECKING:
    from trundle.ros.message_types import geometry_msgs

_STRAIGHT_RAD = 1e-6
"""Turn below which an arc is integrated as a line [rad]."""


class AckermannSteering:
    """Drives by `~cmd_vel`: linear.x is a speed, and angular.z the steering angle [rad], as in the original.

    Parameters, with the original's defaults:

    - rear_wheel (rear_wheel_joint): joint driven by velocity.
    - front_steer (front_steer_joint): joint steered by position.
    - wheel_separation_h: wheelbase [m]; by default the joints' distance along x.
    - wheel_radius [m]: by default the model's.
    - wheel_separation_h_multiplier, wheel_radius_multiplier, steer_pos_multiplier (1): factors for odometry alone.
    - open_loop (false): true integrates the command for odometry, with angular.z as a yaw rate.
    - publish_rate (50), velocity_rolling_window_size (10), cmd_vel_timeout (0.5).
    - allow_multiple_cmd_vel_publishers (true).
    - base_frame_id (base_link), odom_frame_id (odom), enable_odom_tf (true).
    - linear/x and angular/z: has_, max_ and min_ velocity_limits, acceleration_limits and jerk_limits.
    - pose_covariance_diagonal, twist_covariance_diagonal.
    """

    def __init__(self, context: ControllerContext) -> None:
        settings = context.settings
        self._node = context.node
        self._wheel = context.joint(settings.text("rear_wheel", "rear_wheel_joint"), "VelocityJointInterface")
        self._steer = context.joint(settings.text("front_steer", "front_steer_joint"), "PositionJointInterface")
        self.claims: dict[Interface | str, list[str]] = {j.interface: [j.name] for j in (self._wheel, self._steer)}
        distance = abs(origin(context, self._wheel)[0] - origin(context, self._steer)[0])
        wheelbase = length(context, "wheel_separation_h", distance or None)
        self._radius = wheel_radius(context, self._wheel)
        self._odometry_radius = self._radius * settings.number("wheel_radius_multiplier", 1.0)
        self._wheelbase = wheelbase * settings.number("wheel_separation_h_multiplier", 1.0)
        self._steer_multiplier = settings.number("steer_pos_multiplier", 1.0)
        self._timeout_ns = round(settings.number("cmd_vel_timeout", 0.5) * 1e9)
        self._open_loop = settings.flag("open_loop", default=False)
        self._allow_multiple_publishers = settings.flag("allow_multiple_cmd_vel_publishers", default=True)
        sections = (settings.section("linear").section("x"), settings.section("angular").section("z"))
        self._limits = tuple(map(speed_limit, sections))
        self._window = max(1, settings.integer("velocity_rolling_window_size", 10))
        self._endpoints = Endpoints()
        self._odometry = BaseOdometry(context, self._endpoints, frame=settings.text("odom_frame_id", "odom"))
        self._commands = context.node.subscribe(
            f"{context.name}/cmd_vel", "geometry_msgs/Twist", self._on_command, queue_size=1
        )
        self._endpoints.add(self._commands)
        self._is_running = False
        self._pose = (0.0, 0.0, 0.0)
        """x, y [m] and yaw [rad]."""
        self._history = [(0.0, 0.0), (0.0, 0.0)]
        """Linear and angular command, each as (last, second to last)."""

    @classmethod
    def create(cls, context: ControllerContext) -> Self:
        """See `Controller.create`."""
        return cls(context)

    def start(self, time_ns: int) -> None:
        """Stop, steer straight, and integrate odometry from the current wheel position."""
        for joint in (self._wheel, self._steer):
            joint.start()
            joint.command = 0.0
        self._odometry.restart(time_ns)
        self._last_position = self._wheel.position
        self._command: tuple[int, float, float] | None = None
        self._speeds: deque[tuple[float, float]] = deque(maxlen=self._window)
        self._is_running = True

    def update(self, time_ns: int, dt: float) -> None:
        """Update and publish odometry, and write the limited command."""
        self._update_odometry(dt)
        if self._odometry.due(time_ns, dt):
            count = max(1, len(self._speeds))
            linear, angular = (sum(speed[i] for speed in self._speeds) / count for i in (0, 1))
            self._odometry.publish(time_ns, self._pose, (linear, 0.0, angular))
        for index, target in enumerate(self._current_command(time_ns)):
            last, previous = self._history[index]
            self._history[index] = (self._limits[index].limit(target, last, previous, dt), last)
        (linear, _), (angle, _) = self._history
        self._wheel.command = linear / self._radius
        self._steer.command = angle

    def stop(self) -> None:
        """Brake, and steer straight."""
        self._is_running = False
        self._wheel.stop()
        self._steer.command = 0.0

    def close(self) -> None:
        """Unregister its topics."""
        self._endpoints.close()

    def _on_command(self, message: "geometry_msgs.Twist") -> None:
        linear, angle = float(message.linear.x), float(message.angular.z)
        if not self._is_running:
            self._node.log.error("Can't accept new commands. Controller is not running.")
        elif not self._allow_multiple_publishers and (count := self._commands.publishers) > 1:
            self._node.log.error(f"Detected {count} publishers. Only 1 publisher is allowed. Going to brake.")
            self._command = None
        elif math.isfinite(linear) and math.isfinite(angle):
            self._command = (self._node.clock.now_ns(), linear, angle)
        else:
            self._node.log.warn("Received NaN in velocity command. Ignoring.")

    def _current_command(self, time_ns: int) -> tuple[float, float]:
        """Last command, or zero if it has timed out."""
        if self._command is None or time_ns - self._command[0] > self._timeout_ns:
            return 0.0, 0.0
        return self._command[1:]

    def _update_odometry(self, dt: float) -> None:
        if self._open_loop:
            distance, turn = (last * dt for last, _ in self._history)
        else:
            rotation, self._last_position = self._wheel.position - self._last_position, self._wheel.position
            distance = rotation * self._odometry_radius
            turn = math.tan(self._steer.position * self._steer_multiplier) * distance / self._wheelbase
        self._pose = arc(self._pose, distance, turn)
        if dt > 0.0:
            self._speeds.append((distance / dt, turn / dt))


def arc(pose: tuple[float, float, float], distance: float, turn: float) -> tuple[float, float, float]:
    """Return the planar pose (x, y [m], yaw [rad]) after an arc with a length [m] and turn [rad]."""
    x, y, yaw = pose
    if abs(turn) < _STRAIGHT_RAD:
        return x + distance * math.cos(yaw + turn / 2), y + distance * math.sin(yaw + turn / 2), yaw + turn
    radius = distance / turn
    return (
        x + radius * (math.sin(yaw + turn) - math.sin(yaw)),
        y - radius * (math.cos(yaw + turn) - math.cos(yaw)),
        yaw + turn,
    )
