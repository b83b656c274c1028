"""teleop_twist_joy/teleop_node: joystick axes to velocity commands while a button is held."""

from typing import TYPE_CHECKING

from trundle.robots.parameters import RosParameters
from trundle.ros import Node

from .host import NodeHost
from .private_parameters import private_parameters

if TYPE_CHECKING:
    from trundle.ros.message_types import sensor_msgs

_LINEAR_AXES = {"x": ("linear", "x"), "y": ("linear", "y"), "z": ("linear", "z")}
_ANGULAR_AXES = {"yaw": ("angular", "z"), "pitch": ("angular", "y"), "roll": ("angular", "x")}


class TeleopTwistJoy:
    """Publishes cmd_vel while ~enable_button is held, faster with ~enable_turbo_button, and one stop on release."""

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node
        self._sent_stop = False

    async def run(self) -> int:
        """Drive until cancelled."""
        node = self._node
        settings = await private_parameters(node)
        self._enable = settings.integer("enable_button", 0)
        self._turbo = settings.integer("enable_turbo_button", -1)
        self._moves = [
            *_axes(settings, "linear", _LINEAR_AXES, single=("x", 1)),
            *_axes(settings, "angular", _ANGULAR_AXES, single=("yaw", 0)),
        ]
        self._commands = node.advertise("cmd_vel", "geometry_msgs/Twist", latch=True, queue_size=1)
        node.subscribe("joy", "sensor_msgs/Joy", self._on_joy, queue_size=1)
        await node.closed.wait()
        return 0

    def _on_joy(self, joy: "sensor_msgs.Joy") -> None:
        if self._turbo >= 0 and _pressed(joy, self._turbo):
            self._send(joy, turbo=True)
        elif _pressed(joy, self._enable):
            self._send(joy, turbo=False)
        elif not self._sent_stop:  # stop only once, so that other nodes may drive
            self._commands.publish({})
            self._sent_stop = True

    def _send(self, joy: "sensor_msgs.Joy", *, turbo: bool) -> None:
        twist: dict[str, dict[str, float]] = {"linear": {}, "angular": {}}
        for (part, axis), index, scale, turbo_scale in self._moves:
            value = float(joy.axes[index]) if 0 <= index < len(joy.axes) else 0.0
            twist[part][axis] = value * (turbo_scale if turbo else scale)
        self._commands.publish(twist)
        self._sent_stop = False


_Move = tuple[tuple[str, str], int, float, float]


def _axes(
    settings: RosParameters, part: str, names: dict[str, tuple[str, str]], *, single: tuple[str, int]
) -> list[_Move]:
    """Read axis_… and scale_…: maps by axis name, or in the old form a number for a single axis."""
    axes, scales = settings.section(f"axis_{part}"), settings.section(f"scale_{part}")
    turbos = settings.section(f"scale_{part}_turbo")
    if axes.names():
        return [
            (names[name], axes.integer(name), scales.number(name, 0.0), turbos.number(name, 0.0))
            for name in axes.names()
            if name in names
        ]
    name, default = single
    scale = settings.number(f"scale_{part}", 0.5)
    turbo = settings.number(f"scale_{part}_turbo", 1.0 if part == "linear" else scale)
    return [(names[name], settings.integer(f"axis_{part}", default), scale, turbo)]


def _pressed(joy: "sensor_msgs.Joy", button: int) -> bool:
    return 0 <= button < len(joy.buttons) and bool(joy.buttons[button])
