"""The pad and the keys that steer a robot.

A press sets the velocity that holds until the next press, as rviz users know it from `teleop_twist_keyboard`.
W A S D and the arrows move viser's own camera, so the keys are I J K L around the hand's resting place.
"""

from collections.abc import Callable
from typing import Literal

import viser

from .requests import Drive, Request

_KEYS: tuple[tuple[str, Literal["I", "J", "K", "L", "X"]], ...] = (
    ("Forward", "I"),
    ("Left", "J"),
    ("Back", "K"),
    ("Right", "L"),
    ("Stop", "X"),
)


class DrivePad:
    """Forward and back set the linear velocity and go straight; left and right bend the way or turn on the spot."""

    def __init__(self, server: viser.ViserServer, send: Callable[[Request], None]) -> None:
        self._send = send
        self._forward = self._left = 0
        gui = server.gui
        with gui.add_folder("Drive"):
            for label, options in (("", ("Left", "Forward", "Right")), (" ", ("Back", "Stop"))):
                group = gui.add_button_group(label, options, hint="Keys: I forward, K back, J left, L right, X stop")
                group.on_click(lambda _, group=group: self._press(group.value))
            self._linear = gui.add_slider("m/s", 0.05, 2.0, 0.05, 0.5)
            self._angular = gui.add_slider("rad/s", 0.05, 3.0, 0.05, 0.5)
        self._linear.on_update(lambda _: self._resend())
        self._angular.on_update(lambda _: self._resend())
        for label, key in _KEYS:
            command = gui.add_command(f"Drive: {label.lower()}", hotkey=key)
            command.on_trigger(lambda _, label=label: self._press(label))

    def _press(self, label: str) -> None:
        match label:
            case "Forward":
                self._forward, self._left = 1, 0
            case "Back":
                self._forward, self._left = -1, 0
            case "Left":
                self._left = 1
            case "Right":
                self._left = -1
            case _:
                self._forward = self._left = 0
        self._command()

    def _resend(self) -> None:
        if self._forward or self._left:
            self._command()

    def _command(self) -> None:
        self._send(Drive(self._forward * float(self._linear.value), self._left * float(self._angular.value)))
