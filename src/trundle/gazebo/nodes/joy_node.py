"""joy/joy_node: the page's joystick or gamepad; without a page, only `~set`."""

import math
from collections.abc import Sequence
from itertools import zip_longest

from trundle.ros import Message, Node

from .host import NodeHost
from .private_parameters import private_parameters
from .rate import Rate

_AXES, _BUTTONS = 8, 11
"""Axes and buttons of a common gamepad."""
_IDLE_RATE_HZ = 1.0
_MAX_DEAD_ZONE = 0.9
"""Maximum dead zone."""


class JoyNode:
    """Publishes joy on changes, and at ~autorepeat_rate."""

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments
        self._node = node
        self._display = host.display
        self._axes = [0.0] * _AXES
        self._buttons = [0] * _BUTTONS
        self._pressed = self._buttons

    async def run(self) -> int:
        """Publish until cancelled."""
        node = self._node
        settings = await private_parameters(node)
        repeat_hz = settings.number("autorepeat_rate", 0.0)
        self._dead_zone = min(max(settings.number("deadzone", 0.05), 0.0), _MAX_DEAD_ZONE)
        self._sticky = settings.flag("sticky_buttons", default=False)
        self._joy = node.advertise("joy", "sensor_msgs/Joy", queue_size=1)
        set_topic = node.subscribe("~set", "sensor_msgs/Joy", self._set, queue_size=1)
        device = settings.text("dev", "/dev/input/js0")
        message = f"{device} is not read; publish on {set_topic.topic} to move the joystick"
        node.log.info(message if self._display is None else f"{message}, or use the page's joystick or a gamepad")
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
        self._hold(message.axes, message.buttons)
        self._publish()

    def _move(self, axes: Sequence[float], buttons: Sequence[int]) -> None:
        before = (self._axes, self._buttons)
        self._hold(axes, buttons)
        if before != (self._axes, self._buttons):
            self._publish()

    def _hold(self, axes: Sequence[float], buttons: Sequence[int]) -> None:
        """Set axes and buttons; axes are rescaled outside the dead zone, sticky buttons toggle on press."""
        dead_zone = self._dead_zone
        self._axes = [math.copysign(max(abs(value) - dead_zone, 0.0) / (1.0 - dead_zone), value) for value in axes]
        pressed, last = [int(value) for value in buttons], self._pressed
        self._pressed = pressed
        if not self._sticky:
            self._buttons = pressed
            return
        presses = [
            pressed_now > pressed_before for pressed_now, pressed_before in zip_longest(pressed, last, fillvalue=0)
        ]
        self._buttons = [int(is_press) ^ is_on for is_press, is_on in zip_longest(presses, self._buttons, fillvalue=0)]

    def _publish(self) -> None:
        header = {"stamp": self._node.clock.now_ns()}
        self._joy.publish({"header": header, "axes": self._axes, "buttons": self._buttons})
