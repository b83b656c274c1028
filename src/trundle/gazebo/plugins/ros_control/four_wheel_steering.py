"""four_wheel_steering_controller/FourWheelSteeringController: four wheels that are driven and steered."""

import math
from collections import deque
from typing import TYPE_CHECKING, Any, Self

from trundle.robots.parameters import ParamError
from trundle.sim.control import FourWheelSteering, Wheels, axle_angle

from .base_odometry import BaseOdometry
from .controller import ControllerContext, Endpoints
from .drive_settings import joint_names, length, origin, speed_limit, wheel_radius
from .hardware import JointHardware
from .transmissions import Interface

if TYPE_CHECKING:
    from trundle.ros.message_types import four_wheel_steering_msgs, geometry_msgs

_PACKAGE = "four_wheel_steering_msgs"


class FourWheelDrive:
    """Drives by the later of `~cmd_vel` (axles steered oppositely) and `~cmd_four_wheel_steering` (an angle per axle).

    Parameters, with the original's defaults: front_wheel, rear_wheel (velocity), front_steering and rear_steering
    (position), each a left and a right joint (required); track (between the front wheels), wheel_base (between the
    axles) and wheel_radius, by default the model's; publish_rate 50, velocity_rolling_window_size 10, cmd_vel_timeout
    0.5, base_frame_id base_link, enable_odom_tf true; linear/x and angular/z, each with has_X_limits, max_X and min_X
    for X velocity, acceleration and jerk; pose_ and twist_covariance_diagonal. Odometry is published in the frame odom,
    and as speed and steering angles with their rates on `~odom_steer`. The original's rates have the wrong sign, and
    its wheel offset is wrong; here both are right.
    """

    def __init__(self, context: ControllerContext) -> None:
        settings = context.settings
        self._node = context.node
        self._wheels = _pair(context, "front_wheel", "VelocityJointInterface")
        self._wheels += _pair(context, "rear_wheel", "VelocityJointInterface")
        self._steers = _pair(context, "front_steering", "PositionJointInterface")
        self._steers += _pair(context, "rear_steering", "PositionJointInterface")
        self.claims: dict[Interface | str, list[str]] = {
            group[0].interface: [joint.name for joint in group] for group in (self._wheels, self._steers)
        }
        self._law = self._geometry(context)
        self._timeout_ns = round(settings.number("cmd_vel_timeout", 0.5) * 1e9)
        sections = (settings.section("linear").section("x"), settings.section("angular").section("z"))
        self._limits = tuple(map(speed_limit, sections))
        self._window = max(1, settings.integer("velocity_rolling_window_size", 10))
        self._endpoints = Endpoints()
        self._odometry = BaseOdometry(context, self._endpoints, frame="odom")
        kind = f"{_PACKAGE}/FourWheelSteeringStamped"
        self._steering_topic = context.node.advertise(f"{context.name}/odom_steer", kind, queue_size=100)
        self._endpoints.add(
            self._steering_topic,
            context.node.subscribe(f"{context.name}/cmd_vel", "geometry_msgs/Twist", self._on_twist, queue_size=1),
            context.node.subscribe(
                f"{context.name}/cmd_four_wheel_steering",
                f"{_PACKAGE}/FourWheelSteering",
                self._on_steering,
                queue_size=1,
            ),
        )
        settings.flag("open_loop", default=False)  # the original declares it without effect, too
        self._is_running = False
        self._pose = (0.0, 0.0, 0.0)
        """x, y [m] and yaw [rad]."""
        self._history = [(0.0, 0.0), (0.0, 0.0)]
        """(last, last but one) command: linear, angular."""

    @classmethod
    def create(cls, context: ControllerContext) -> Self:
        """See `Controller.create`."""
        return cls(context)

    def start(self, time_ns: int) -> None:
        """Stop, and steer straight."""
        for joint in (*self._wheels, *self._steers):
            joint.start()
            joint.command = 0.0
        self._odometry.restart(time_ns)
        self._twist: tuple[int, float, float] = (-1, 0.0, 0.0)
        """Stamp [ns], forward speed [m/s], yaw rate [rad/s]."""
        self._angles: tuple[int, float, float, float] = (-1, 0.0, 0.0, 0.0)
        """Stamp [ns], speed [m/s], front and rear angle [rad]."""
        self._samples: deque[tuple[float, float, float, float]] = deque(maxlen=self._window + 1)
        """Speed [m/s], both angles [rad] and time since the previous sample [s]."""
        self._is_running = True

    def update(self, time_ns: int, dt: float) -> None:
        """Update and publish odometry, and write the limited command."""
        speeds: Wheels = tuple(joint.velocity for joint in self._wheels)  # pyright: ignore[reportAssignmentType]
        fl, fr, rl, rr = (joint.position for joint in self._steers)
        front, rear = axle_angle(fl, fr), axle_angle(rl, rr)
        forward, sideways, yaw_rate = self._law.forward_kinematics(speeds, front, rear)
        x, y, yaw = self._pose
        cos, sin = math.cos(yaw), math.sin(yaw)
        self._pose = (
            x + (forward * cos - sideways * sin) * dt,
            y + (forward * sin + sideways * cos) * dt,
            yaw + yaw_rate * dt,
        )
        self._samples.append((math.copysign(math.hypot(forward, sideways), forward), front, rear, dt))
        if self._odometry.due(time_ns, dt):
            self._odometry.publish(time_ns, self._pose, (forward, sideways, yaw_rate))
            self._publish_angles(time_ns)
        self._drive(time_ns, dt)

    def stop(self) -> None:
        """Brake, and steer straight."""
        self._is_running = False
        for joint in self._wheels:
            joint.stop()
        for joint in self._steers:
            joint.command = 0.0

    def close(self) -> None:
        """Unregister its topics."""
        self._endpoints.close()

    def _drive(self, time_ns: int, dt: float) -> None:
        if self._angles[0] >= self._twist[0]:
            stamp, speed, front, rear = self._angles
            speed, front, rear = (speed, front, rear) if time_ns - stamp <= self._timeout_ns else (0.0, 0.0, 0.0)
            speeds, angles = self._law.command_for_angles(self._limited(0, speed, dt), front, rear)
        else:
            stamp, forward, yaw_rate = self._twist
            forward, yaw_rate = (forward, yaw_rate) if time_ns - stamp <= self._timeout_ns else (0.0, 0.0)
            speeds, angles = self._law.command_for_twist(self._limited(0, forward, dt), self._limited(1, yaw_rate, dt))
        for joint, command in zip((*self._wheels, *self._steers), (*speeds, *angles), strict=True):
            joint.command = command

    def _limited(self, index: int, target: float, dt: float) -> float:
        last, previous = self._history[index]
        limited = self._limits[index].limit(target, last, previous, dt)
        self._history[index] = (limited, last)
        return limited

    def _publish_angles(self, time_ns: int) -> None:
        if not self._steering_topic.has_subscribers:
            return
        first, last = self._samples[0], self._samples[-1]
        elapsed = sum(sample[3] for sample in list(self._samples)[1:])
        rates = [(b - a) / elapsed if elapsed > 0.0 else 0.0 for a, b in zip(first[:3], last[:3], strict=True)]
        data: dict[str, Any] = {
            "speed": last[0],
            "acceleration": rates[0],
            "front_steering_angle": last[1],
            "rear_steering_angle": last[2],
            "front_steering_angle_velocity": rates[1],
            "rear_steering_angle_velocity": rates[2],
        }
        self._steering_topic.publish({"header": {"stamp": time_ns, "frame_id": "odom"}, "data": data})

    def _on_twist(self, message: "geometry_msgs.Twist") -> None:
        values = (float(message.linear.x), float(message.angular.z))
        if self._accepts("geometry_msgs::Twist", values):
            self._twist = (self._node.clock.now_ns(), *values)

    def _on_steering(self, message: "four_wheel_steering_msgs.FourWheelSteering") -> None:
        values = (float(message.speed), float(message.front_steering_angle), float(message.rear_steering_angle))
        if self._accepts("four_wheel_steering_msgs::FourWheelSteering", values):
            self._angles = (self._node.clock.now_ns(), *values)

    def _accepts(self, kind: str, values: tuple[float, ...]) -> bool:
        if not self._is_running:
            self._node.log.error("Can't accept new commands. Controller is not running.")
        elif not all(map(math.isfinite, values)):
            self._node.log.warn(f"Received NaN in {kind}. Ignoring command.")
        else:
            return True
        return False

    def _geometry(self, context: ControllerContext) -> FourWheelSteering:
        """Return the geometry from the parameters, else from the model."""
        front, rear, steer = self._wheels[0], self._wheels[2], self._steers[0]
        offset = math.dist(origin(context, steer), origin(context, front))
        front_distance = math.dist(origin(context, front), origin(context, self._wheels[1]))
        return FourWheelSteering(
            track=length(context, "track", front_distance) - 2 * offset,
            offset=offset,
            radius=wheel_radius(context, front),
            base=length(context, "wheel_base", math.dist(origin(context, front), origin(context, rear))),
        )


def _pair(context: ControllerContext, name: str, interface: Interface) -> list[JointHardware]:
    """Return the left and the right joint of a parameter."""
    names = joint_names(context.settings, name)
    if len(names) != 2:
        raise ParamError(f"parameter {context.name}/{name} must be a left and a right joint, got {', '.join(names)}")
    return [context.joint(joint, interface) for joint in names]
