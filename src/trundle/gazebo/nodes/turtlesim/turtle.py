"""A turtle: pose, motion and pen."""

import math
from collections import deque
from dataclasses import dataclass

Color = tuple[int, int, int]
_COMMAND_TIMEOUT_NS = 1_000_000_000
"""A turtle stops after a second without commands."""
_MAX_PENDING = 100
_Velocity = tuple[float, float, float]
_REST: _Velocity = (0.0, 0.0, 0.0)


@dataclass(slots=True, kw_only=True)
class Pen:
    """Line style of a turtle's path."""

    color: Color = (0xB3, 0xB8, 0xFF)
    width_px: int = 3
    on: bool = True


class Turtle:
    """Moves on the plane from (0, 0) to (size, size) [m], by the original's metres per pixel."""

    def __init__(self, x: float, y: float, theta: float, *, size: float) -> None:
        self.x, self.y, self.theta = x, y, theta
        self.pen = Pen()
        self.linear_velocity = 0.0
        self.angular_velocity = 0.0
        self.hit_wall = False
        """True if the last move ended at a wall."""
        self._size = size
        self._command = _REST
        self._command_ns = 0
        self._pending: deque[tuple[int, _Velocity]] = deque(maxlen=_MAX_PENDING)
        """Commands with their time of arrival [ns]."""

    def command(self, x: float, y: float, turn: float, *, now_ns: int) -> None:
        """Queue a velocity command [m/s, m/s, rad/s], valid for one second."""
        self._pending.append((now_ns, (x, y, turn)))

    def update(self, dt_s: float, *, now_ns: int) -> None:
        """Move for `dt_s`, with the last command that arrived by `now_ns`."""
        while self._pending and self._pending[0][0] <= now_ns:
            self._command_ns, self._command = self._pending.popleft()
        if abs(now_ns - self._command_ns) > _COMMAND_TIMEOUT_NS:  # or time jumped back
            self._command = _REST
        forward, sideways, turn = self._command
        self.theta = _wrapped(self.theta + turn * dt_s)
        cos, sin = math.cos(self.theta), math.sin(self.theta)
        x = self.x + (cos * forward - sin * sideways) * dt_s
        y = self.y + (sin * forward + cos * sideways) * dt_s
        self.teleport(x, y, self.theta)
        self.linear_velocity, self.angular_velocity = math.hypot(forward, sideways), turn

    def teleport(self, x: float, y: float, theta: float) -> None:
        """Set the pose, clamped to the walls."""
        self.x, self.y = min(max(x, 0.0), self._size), min(max(y, 0.0), self._size)
        self.hit_wall = (self.x, self.y) != (x, y)
        self.theta = _wrapped(theta)

    def teleport_relative(self, distance: float, turn: float) -> None:
        """Turn, then jump ahead by a distance."""
        theta = self.theta + turn
        self.teleport(self.x + math.cos(theta) * distance, self.y + math.sin(theta) * distance, theta)


def _wrapped(angle: float) -> float:
    """Wrap an angle to −π … π."""
    return math.remainder(angle, math.tau)
