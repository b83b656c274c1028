"""joy/joy_node: a joystick of the page, drawn or plugged in there; without a page at rest until `~set` moves it."""

from collections.abc import Sequence

from trundle.ros import Message, Node, Settings

from .host import Host
from .rate import Rate

_AXES, _BUTTONS = 8, 11
"""Those of the usual game pad."""
_IDLE_RATE_HZ = 1.0


class JoyNode:
    """Publishes joy when it is moved, and again at ~autorepeat_rate."""

    def __init__(self, node: Node, arguments: list[str], host: Host) -> None:
        del arguments
        self._node = node
        self._display = host.display
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
        said = f"{device} is not read; publish on {asked.topic} to move the joystick"
        node.log_info(said if self._display is None else f"{said}, or move that of the page, or one plugged in there")
        window = None
        if self._display is not None:
            self._display.offer_joystick(self._move)
            window = node.loop.spawn(self._display.show(node, config=None, fixed_frame=None))
        try:
            return await self._repeat(repeat_hz)
        finally:
            if window is not None:
                window.cancel()

    async def _repeat(self, repeat_hz: float) -> int:
        rate = Rate(self._node, repeat_hz if repeat_hz > 0.0 else _IDLE_RATE_HZ)
        while True:
            if repeat_hz > 0.0:
                self._publish()
            await rate.sleep()

    def _set(self, message: Message) -> None:
        self._axes = [0.0 if abs(value) < self._dead_zone else float(value) for value in message.axes]
        self._buttons = [int(value) for value in message.buttons]
        self._publish()

    def _move(self, axes: Sequence[float], buttons: Sequence[int]) -> None:
        now = ([0.0 if abs(value) < self._dead_zone else value for value in axes], list(buttons))
        if now != (self._axes, self._buttons):
            self._axes, self._buttons = now
            self._publish()

    def _publish(self) -> None:
        header = {"stamp": self._node.clock.now_ns()}
        self._joy.publish({"header": header, "axes": self._axes, "buttons": self._buttons})
