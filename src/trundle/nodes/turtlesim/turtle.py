"""One turtle: where it is, how it moves, and the pen it holds."""

import math
from dataclasses import dataclass

Colour = tuple[int, int, int]
_COMMAND_HOLDS_NS = 1_000_000_000
"""A turtle that hears nothing for a second stops."""


@dataclass(slots=True, kw_only=True)
class Pen:
    """What a turtle draws with."""

    colour: Colour = (0xB3, 0xB8, 0xFF)
    width_px: int = 3
    on: bool = True


class Turtle:
    """Moves on the plane from (0, 0) to (size, size), in metres that the original made of pixels."""

    def __init__(self, x: float, y: float, theta: float, *, size: float) -> None:
        self.x, self.y, self.theta = x, y, theta
        self.pen = Pen()
        self.linear_velocity = 0.0
        self.angular_velocity = 0.0
        self.hit_wall = False
        """Whether the last move ended at a wall."""
        self._size = size
        self._command = (0.0, 0.0, 0.0)
        self._command_ns: int | None = None

    def command(self, x: float, y: float, turn: float, *, now_ns: int) -> None:
        """Take a velocity [m/s, m/s, rad/s], for one second."""
        self._command = (x, y, turn)
        self._command_ns = now_ns

    def move(self, dt_s: float, *, now_ns: int) -> None:
        """Move for a time."""
        if self._command_ns is None or now_ns - self._command_ns > _COMMAND_HOLDS_NS:
            self._command = (0.0, 0.0, 0.0)
        forwards, sideways, turn = self._command
        self.theta = _wrapped(self.theta + turn * dt_s)
        cos, sin = math.cos(self.theta), math.sin(self.theta)
        x = self.x + (cos * forwards - sin * sideways) * dt_s
        y = self.y + (sin * forwards + cos * sideways) * dt_s
        self.place(x, y, self.theta)
        self.linear_velocity, self.angular_velocity = math.hypot(forwards, sideways), turn

    def place(self, x: float, y: float, theta: float) -> None:
        """Put it somewhere, inside the walls."""
        self.x, self.y = min(max(x, 0.0), self._size), min(max(y, 0.0), self._size)
        self.hit_wall = (self.x, self.y) != (x, y)
        self.theta = _wrapped(theta)

    def step_ahead(self, distance: float, turn: float) -> None:
        """Turn, then go a distance at once."""
        theta = self.theta + turn
        self.place(self.x + math.cos(theta) * distance, self.y + math.sin(theta) * distance, theta)


def _wrapped(angle: float) -> float:
    """An angle between −π and π."""
    return math.remainder(angle, math.tau)
