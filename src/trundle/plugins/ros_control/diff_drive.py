"""diff_drive_controller/DiffDriveController: a body speed in; wheel speeds, odometry and tf out."""

import math
from collections import deque
from typing import Any, Self

from trundle.control import DifferentialDrive, SpeedLimit, WheelOdometry
from trundle.model import Cylinder, Sphere, model_from_joint
from trundle.ros import Message, SettingError, Settings, Transform, TransformBroadcaster

from .controller import Cadence, Ends, Site
from .hardware import JointHardware
from .transmissions import Interface

_VELOCITY: Interface = "VelocityJointInterface"
_WINDOW = 10


class DiffDriveController:
    """Two wheels, or two rows of them.

    Parameters, with the original's defaults: left_wheel, right_wheel (a joint or several; required), wheel_separation
    and wheel_radius (those of the model), wheel_separation_multiplier, left_ and right_wheel_radius_multiplier 1,
    publish_rate 50, cmd_vel_timeout 0.5, open_loop false, base_frame_id base_link, odom_frame_id odom, enable_odom_tf
    true, velocity_rolling_window_size 10, linear/x and angular/z with has_, max_ and min_ velocity_limits,
    acceleration_limits and jerk_limits, pose_ and twist_covariance_diagonal, publish_cmd false.
    """

    def __init__(self, site: Site) -> None:
        settings = site.settings
        self._site = site
        self._left = [site.joint(name, _VELOCITY) for name in _wheels(settings, "left_wheel")]
        self._right = [site.joint(name, _VELOCITY) for name in _wheels(settings, "right_wheel")]
        if len(self._left) != len(self._right):
            raise SettingError(
                f"{site.name}: {len(self._left)} left wheels, but {len(self._right)} right ones; as many are needed"
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
        self._frame, self._base = settings.text("odom_frame_id", "odom"), settings.text("base_frame_id", "base_link")
        self._limits = (
            _limit(settings.section("linear").section("x")),
            _limit(settings.section("angular").section("z")),
        )
        self._pose_covariance = _diagonal(settings, "pose_covariance_diagonal")
        self._twist_covariance = _diagonal(settings, "twist_covariance_diagonal")
        self._cadence = Cadence(settings.rate_hz("publish_rate", 50.0))
        self._window = max(1, round(settings.number("velocity_rolling_window_size", _WINDOW)))
        self._advertise(settings)
        self._forget()

    def _advertise(self, settings: Settings) -> None:
        site = self._site
        self._odometry_topic = site.node.advertise(f"{site.name}/odom", "nav_msgs/Odometry", queue_size=100)
        has_tf = settings.flag("enable_odom_tf", default=True)
        self._broadcaster = TransformBroadcaster(site.node) if has_tf else None
        self._ends = Ends()
        self._ends.add(self._odometry_topic)
        self._ends.add(site.node.subscribe(f"{site.name}/cmd_vel", "geometry_msgs/Twist", self._take, queue_size=1))
        self._told = None
        if settings.flag("publish_cmd", default=False):
            self._told = site.node.advertise(f"{site.name}/cmd_vel_out", "geometry_msgs/TwistStamped", queue_size=100)
            self._ends.add(self._told)

    @classmethod
    def make(cls, site: Site) -> Self:
        """See `Controller.make`."""
        return cls(site)

    def start(self, time_ns: int) -> None:
        """Stand still, and count the wheels' turns from here."""
        for joint in (*self._left, *self._right):
            joint.engage()
        self._cadence.restart(time_ns)
        self._turned = self._turns()
        self._command = None

    def update(self, time_ns: int, dt: float) -> None:
        """Add up what the wheels did, tell it, and drive on."""
        self._count(dt)
        if self._cadence.due(time_ns):
            self._tell(time_ns)
        linear, angular = self._wanted(time_ns)
        for number, wanted in enumerate((linear, angular)):
            last, before = self._history[number]
            limited = self._limits[number].limited(wanted, last, before, dt)
            self._history[number] = (limited, last)
        (linear, _), (angular, _) = self._history
        if self._told is not None and self._told.has_subscribers:
            header = {"stamp": time_ns, "frame_id": self._base}
            twist = {"linear": {"x": linear}, "angular": {"z": angular}}
            self._told.publish({"header": header, "twist": twist})
        half = angular * self._drive.separation / 2
        for joints, speed, radius in zip(
            (self._left, self._right), (linear - half, linear + half), self._radii, strict=True
        ):
            for joint in joints:
                joint.command = speed / radius

    def stop(self) -> None:
        """Brake."""
        for joint in (*self._left, *self._right):
            joint.rest()

    def close(self) -> None:
        """Leave the graph."""
        self._ends.close()

    def _take(self, message: Message) -> None:
        if math.isfinite(message.linear.x) and math.isfinite(message.angular.z):
            stamp = self._site.node.clock.now_ns()
            self._command = (stamp, float(message.linear.x), float(message.angular.z))
        else:
            self._site.node.log_warn("Received NaN in velocity command. Ignoring.")

    def _wanted(self, time_ns: int) -> tuple[float, float]:
        """What was commanded, unless that is too old."""
        if self._command is None or time_ns - self._command[0] > self._timeout_ns:
            return 0.0, 0.0
        return self._command[1:]

    def _forget(self) -> None:
        self._command: tuple[int, float, float] | None = None
        self._history = [(0.0, 0.0), (0.0, 0.0)]
        """Last and last but one command, linear and angular."""
        self._place = WheelOdometry(self._drive)
        self._turned = (0.0, 0.0)
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
                (new - old) * radius for new, old, radius in zip(now, self._turned, self._radii, strict=True)
            )
            self._turned = now
        radius = self._drive.wheel_radius
        distance, turn = self._place.roll(left / radius, right / radius)
        if dt > 0.0:
            self._speeds.append((distance / dt, turn / dt))

    def _tell(self, time_ns: int) -> None:
        place = self._place
        turn = {"z": math.sin(place.yaw / 2), "w": math.cos(place.yaw / 2)}
        if self._odometry_topic.has_subscribers:
            count = max(1, len(self._speeds))
            linear, angular = (sum(speed[i] for speed in self._speeds) / count for i in (0, 1))
            pose = {"position": {"x": place.x, "y": place.y}, "orientation": turn}
            self._odometry_topic.publish(
                {
                    "header": {"stamp": time_ns, "frame_id": self._frame},
                    "child_frame_id": self._base,
                    "pose": {"pose": pose, "covariance": self._pose_covariance},
                    "twist": {
                        "twist": {"linear": {"x": linear}, "angular": {"z": angular}},
                        "covariance": self._twist_covariance,
                    },
                }
            )
        if self._broadcaster is not None:
            self._broadcaster.send(
                Transform(
                    parent=self._frame,
                    child=self._base,
                    stamp_ns=time_ns,
                    translation=(place.x, place.y, 0.0),
                    rotation=(turn["w"], 0.0, 0.0, turn["z"]),
                )
            )

    def _geometry(self, settings: Settings) -> DifferentialDrive:
        """As the parameters say, else as the model has it."""
        names = settings.names()
        separation = (
            settings.number("wheel_separation")
            if "wheel_separation" in names
            else self._apart(self._left[0], self._right[0])
        )
        radius = settings.number("wheel_radius") if "wheel_radius" in names else self._radius(self._left[0])
        if not (separation > 0.0 and radius > 0.0):
            raise SettingError(f"{self._site.name}: wheel_separation and wheel_radius must be > 0 m")
        separation *= settings.number("wheel_separation_multiplier", 1.0)
        return DifferentialDrive(wheel_radius=radius, separation=separation)

    def _apart(self, one: JointHardware, other: JointHardware) -> float:
        model = self._site.model.model
        a, b = (model_from_joint(model, joint.handle.joint).position for joint in (one, other))
        return math.dist(a, b)

    def _radius(self, wheel: JointHardware) -> float:
        link = self._site.model.link(wheel.handle.joint.child).link
        for collision in link.collisions:
            if isinstance(collision.geometry, Cylinder | Sphere):
                return collision.geometry.radius
        raise SettingError(
            f"parameter {self._site.name}/wheel_radius is not set, and link {link.name!r} has neither a cylinder nor "
            "a sphere to measure"
        )


def _wheels(settings: Settings, name: str) -> list[str]:
    """One joint, or a list of them."""
    try:
        return [settings.text(name)]
    except SettingError:
        wheels = settings.texts(name)
        if not wheels:
            raise
        return wheels


def _limit(settings: Settings) -> SpeedLimit:
    """max_… and min_…, of which the one that is missing is the other's negative."""

    def bounds(what: str) -> tuple[float, float]:
        if not settings.flag(f"has_{what}_limits", default=False):
            return -math.inf, math.inf
        largest = settings.number(f"max_{what}")
        return settings.number(f"min_{what}", -largest), largest

    slowest, fastest = bounds("velocity")
    braking, speeding = bounds("acceleration")
    lowest, highest = bounds("jerk")
    return SpeedLimit(
        slowest=slowest,
        fastest=fastest,
        hardest_braking=braking,
        hardest=speeding,
        lowest_jerk=lowest,
        highest_jerk=highest,
    )


def _diagonal(settings: Settings, name: str) -> list[float]:
    """A 6×6 covariance from its diagonal; absent is zero."""
    values: list[Any] = settings.items(name) or [0.0] * 6
    if len(values) != 6 or not all(isinstance(value, int | float) for value in values):
        raise SettingError(f"{name} must be 6 numbers, got {values!r}")
    return [float(values[row]) if row == column else 0.0 for row in range(6) for column in range(6)]
