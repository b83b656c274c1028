"""arbotix_python's diff_controller, simulated: /cmd_vel in, odometry out."""

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from trundle.robots.parameters import RosParameters
from trundle.ros import Node, Transform, TransformBroadcaster

from ..rate import RateDivider
from .controller import DiagnosticStatus, JointReading

if TYPE_CHECKING:
    from trundle.ros.message_types import geometry_msgs


@dataclass(slots=True)
class Unicycle:
    """Odometry by forward Euler integration, as in the original.

    Velocities hold until set again: the original's timeout and acceleration limit apply to set-points of real motors
    only.
    """

    x: float = 0.0
    """[m]"""
    y: float = 0.0
    """[m]"""
    heading: float = 0.0
    """[rad], not wrapped."""
    speed: float = 0.0
    """[m/s]"""
    turn_rate: float = 0.0
    """[rad/s]"""

    def integrate(self, elapsed_s: float) -> None:
        """Integrate over an interval, with the heading at its start."""
        self.x += math.cos(self.heading) * self.speed * elapsed_s
        self.y += math.sin(self.heading) * self.speed * elapsed_s
        self.heading += self.turn_rate * elapsed_s


class DiffController:
    """Drives the base and publishes odom and its transform."""

    def __init__(self, node: Node, name: str, settings: RosParameters) -> None:
        """Create from `~controllers/<name>`.

        Raises:
            ParamError: the geometry is missing, or a parameter is invalid.
        """
        rate_hz = settings.number("rate", 10.0, above=0.0)
        ticks_meter = settings.number("ticks_meter")
        base_width = settings.number("base_width")
        self._node = node
        self._name = name
        self._base_frame = settings.text("base_frame_id", "base_link")
        self._odom_frame = settings.text("odom_frame_id", "odom")
        self._divider = RateDivider(node.clock.now_ns, rate_hz)
        self._last_ns = node.clock.now_ns()
        self._base = Unicycle()
        # The original's names, independent of the robot's; simulated wheels do not turn.
        self.readings = [JointReading(name="base_l_wheel_joint"), JointReading(name="base_r_wheel_joint")]
        node.subscribe("cmd_vel", "geometry_msgs/Twist", self._command)
        self._odom = node.advertise("odom", "nav_msgs/Odometry", queue_size=5)
        self._broadcaster = TransformBroadcaster(node)
        node.log.info(f"Started DiffController ({name}). Geometry: {base_width}m wide, {ticks_meter} ticks/m.")

    def _command(self, twist: "geometry_msgs.Twist") -> None:
        """Apply new velocities from now on.

        The original applies them to the whole interval since its last update, up to 0.15 s before the command: the
        position would then depend on the command's time within that interval, by up to 7.5 cm (docs/decisions/0006).
        """
        speed, turn_rate = float(twist.linear.x), float(twist.angular.z)
        if (speed, turn_rate) != (self._base.speed, self._base.turn_rate):
            self._integrate(self._node.clock.now_ns())
            self._base.speed, self._base.turn_rate = speed, turn_rate

    def _integrate(self, now_ns: int) -> None:
        self._base.integrate(max(0, now_ns - self._last_ns) / 1e9)
        self._last_ns = now_ns

    def update(self) -> None:
        """Integrate and publish, if due."""
        now = self._node.clock.now_ns()
        if not self._divider.due():
            return
        self._integrate(now)
        half_yaw = self._base.heading / 2.0
        self._broadcaster.send_transform(
            Transform(
                parent=self._odom_frame,
                child=self._base_frame,
                stamp_ns=self._node.clock.now_ns(),
                translation=(self._base.x, self._base.y, 0.0),
                rotation=(math.cos(half_yaw), 0.0, 0.0, math.sin(half_yaw)),
            )
        )
        self._odom.publish(
            {
                "header": {"stamp": now, "frame_id": self._odom_frame},
                "child_frame_id": self._base_frame,
                "pose": {
                    "pose": {
                        "position": {"x": self._base.x, "y": self._base.y, "z": 0.0},
                        "orientation": {"x": 0.0, "y": 0.0, "z": math.sin(half_yaw), "w": math.cos(half_yaw)},
                    }
                },
                "twist": {
                    "twist": {"linear": {"x": self._base.speed}, "angular": {"z": self._base.turn_rate}},
                },
            }
        )

    def status(self) -> DiagnosticStatus:
        """Name, OK and the velocities."""
        return DiagnosticStatus(
            name=self._name, values=(("dX", str(self._base.speed)), ("dR", str(self._base.turn_rate)))
        )
