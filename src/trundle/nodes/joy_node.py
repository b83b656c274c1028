"""joy/joy_node without a joystick: a virtual one at rest, which `~set` moves."""

from trundle.ros import Message, Node, Settings

from .host import Host
from .rate import Rate

_AXES, _BUTTONS = 8, 11
"""Those of the usual game pad."""
_IDLE_RATE_HZ = 1.0


class JoyNode:
    """Publishes joy when it is moved, and again at ~autorepeat_rate."""

    def __init__(self, node: Node, arguments: list[str], host: Host) -> None:
        del arguments, host
        self._node = node
        self._axes = [0.0] * _AXES
        self._buttons = [0] * _BUTTONS

    async def run(self) -> int:
        """Publish until cancelled."""
        node = self._node
        settings = Settings(await node.get_param("~", {}), node.name)
        repeat_hz = settings.number("autorepeat_rate", 0.0)
        self._dead_zone = settings.number("deadzone", 0.05)
        self._joy = node.advertise("joy", "sensor_msgs/Joy", queue_size=1)
        asked = node.subscribe("~set", "sensor_msgs/Joy", self._set, queue_size=1)
        device = settings.text("dev", "/dev/input/js0")
        node.log_info(f"no joystick is read ({device}): a virtual one is at rest; publish on {asked.topic} to move it")
        rate = Rate(node, repeat_hz if repeat_hz > 0.0 else _IDLE_RATE_HZ)
        while True:
            if repeat_hz > 0.0:
                self._publish()
            await rate.sleep()

    def _set(self, message: Message) -> None:
        self._axes = [0.0 if abs(value) < self._dead_zone else float(value) for value in message.axes]
        self._buttons = [int(value) for value in message.buttons]
        self._publish()

    def _publish(self) -> None:
        header = {"stamp": self._node.clock.now_ns()}
        self._joy.publish({"header": header, "axes": self._axes, "buttons": self._buttons})
