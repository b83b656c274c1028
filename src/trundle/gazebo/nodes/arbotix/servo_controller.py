"""arbotix_python's servos, simulated."""

import math
from collections.abc import Callable
from typing import TYPE_CHECKING

from trundle.robots.parameters import RosParameters
from trundle.ros import Node

from ..rate import RateDivider
from .controller import ArbotixJoint, DiagnosticStatus, JointReading

if TYPE_CHECKING:
    from trundle.ros.message_types import arbotix_msgs, std_msgs


class Servo:
    """A servo with a speed limit and a resolution in ticks."""

    def __init__(
        self,
        node: Node,
        name: str,
        settings: RosParameters,
        *,
        ticks: float,
        neutral: float | None,
        range_deg: float | None,
        max_speed_deg: float,
    ) -> None:
        """Create from `~joints/<name>`; the other arguments are defaults of the servo type.

        Raises:
            ParamError: no id, or an invalid parameter.
        """
        settings.number("id")
        self.reading = JointReading(name=name)
        self._node = node
        self._ticks = settings.number("ticks", ticks)
        self._neutral = settings.number("neutral", self._ticks / 2 if neutral is None else neutral)
        default_range = (360.0 if self._ticks == 4096 else 300.0) if range_deg is None else range_deg
        self._rad_per_tick = math.radians(settings.number("range", default_range)) / self._ticks
        self._max_speed = math.radians(settings.number("max_speed", max_speed_deg))
        self._sign = -1.0 if settings.flag("invert", default=False) else 1.0
        self._desired = 0.0
        self._last_command = 0.0
        self._moving = False
        self.is_controlled: Callable[[], bool] = lambda: False
        """True while a controller moves the servo; its topic is then ignored."""

    def on_command(self, message: "std_msgs.Float64") -> None:
        """Handle a command from the topic."""
        if not self.is_controlled():
            self.command(float(message.data))

    def command(self, position: float) -> None:
        """Set the target position [rad]."""
        self._desired = position
        self._moving = True

    def interpolate(self, rate_hz: float) -> None:
        """Move by at most one cycle at the speed limit, rounded to ticks."""
        if not self._moving:
            return
        limit = self._max_speed / rate_hz
        step = min(max(self._desired - self._last_command, -limit), limit)
        self._last_command = self._angle(self._to_ticks(self._last_command + step))
        if self._last_command == self._desired:
            self._moving = False
        self.reading.position = self._last_command

    def _to_ticks(self, angle: float) -> float:
        ticks = self._neutral + self._sign * angle / self._rad_per_tick
        return self._ticks - 1.0 if ticks >= self._ticks else max(ticks, 0.0)

    def _angle(self, ticks: float) -> float:
        return self._sign * (ticks - self._neutral) * self._rad_per_tick

    def status(self) -> DiagnosticStatus:
        """Name, OK and the position."""
        return DiagnosticStatus(name=self.reading.name, values=(("Position", str(self.reading.position)),))


class HobbyServo(Servo):
    """A servo without feedback."""

    def __init__(self, node: Node, name: str, settings: RosParameters) -> None:
        super().__init__(node, name, settings, ticks=2000, neutral=1500, range_deg=180.0, max_speed_deg=90.0)
        node.subscribe(f"{name}/command", "std_msgs/Float64", self.on_command)


class DynamixelServo(Servo):
    """A servo with velocity feedback that can be relaxed and disabled."""

    def __init__(self, node: Node, name: str, settings: RosParameters) -> None:
        super().__init__(node, name, settings, ticks=1024, neutral=None, range_deg=None, max_speed_deg=684.0)
        self._enabled = True
        self._active = False
        self._last_ns = node.clock.now_ns()
        node.subscribe(f"{name}/command", "std_msgs/Float64", self.on_command)
        node.advertise_service(f"{name}/relax", "arbotix_msgs/Relax", self.relax)
        node.advertise_service(f"{name}/enable", "arbotix_msgs/Enable", self.enable)
        # Only the real servo's speed changes; the simulated one keeps its limit.
        node.advertise_service(f"{name}/set_speed", "arbotix_msgs/SetSpeed", _empty_response)

    def command(self, position: float) -> None:
        if self._enabled and (self._desired != position or not self._active):
            self._active = True
            super().command(position)

    def interpolate(self, rate_hz: float) -> None:
        now, last_position = self._node.clock.now_ns(), self.reading.position
        was_moving = self._moving
        super().interpolate(rate_hz)
        elapsed_s = (now - self._last_ns) / 1e9
        has_moved = was_moving and elapsed_s > 0.0
        self.reading.velocity = (self.reading.position - last_position) / elapsed_s if has_moved else 0.0
        self._last_ns = now

    def relax(self, _request: "arbotix_msgs.RelaxRequest") -> dict[str, object]:
        """Stop until the next command."""
        self._moving = self._active = False
        return {}

    def enable(self, request: "arbotix_msgs.EnableRequest") -> dict[str, object]:
        """Accept or ignore commands."""
        self._enabled = bool(request.enable)
        if not self._enabled:
            self._moving = self._active = False
        return {"state": self._enabled}

    def status(self) -> DiagnosticStatus:
        """Diagnostics of the real servo; values without a simulated sensor are 0."""
        values = (
            ("Position", str(self.reading.position)),
            ("Temperature", "0.0"),
            ("Voltage", "0.0"),
            ("Reads", "0.0"),
            ("Error Rate", "0.0%"),
            ("Torque", "ON" if self._active else "OFF"),
        )
        return DiagnosticStatus(name=self.reading.name, values=values)


class ServoController:
    """The driver's built-in controller "servos": moves all servos at `~write_rate`."""

    def __init__(self, node: Node, joints: dict[str, ArbotixJoint], settings: RosParameters) -> None:
        self.readings: list[JointReading] = []
        self._servos = [joint for joint in joints.values() if isinstance(joint, Servo)]
        self._write_rate_hz = settings.number("write_rate", 10.0, above=0.0)
        self._divider = RateDivider(node.clock.now_ns, self._write_rate_hz)
        node.advertise_service("servos/relax_all", "arbotix_msgs/Relax", self._relax_all)
        node.advertise_service("servos/enable_all", "arbotix_msgs/Enable", self._enable_all)

    def update(self) -> None:
        """Move the servos, if due."""
        if self._divider.due():
            for servo in self._servos:
                servo.interpolate(self._write_rate_hz)

    def status(self) -> None:
        """Return None: each servo has its own status."""

    def _relax_all(self, request: "arbotix_msgs.RelaxRequest") -> dict[str, object]:
        for servo in self._servos:
            if isinstance(servo, DynamixelServo):
                servo.relax(request)
        return {}

    def _enable_all(self, request: "arbotix_msgs.EnableRequest") -> dict[str, object]:
        for servo in self._servos:
            if isinstance(servo, DynamixelServo):
                servo.enable(request)
        return {"state": bool(request.enable)}


def _empty_response(_request: "arbotix_msgs.SetSpeedRequest") -> dict[str, object]:
    return {}
