"""The law of two driven wheels: body speed to wheel speeds, and wheel travel back to where the body is."""

import math

from msgspec import Struct


class DifferentialDrive(Struct, frozen=True, kw_only=True):
    """Two wheels on one axle."""

    wheel_radius: float
    """[m]"""
    separation: float
    """Between the wheels' middles [m]."""

    def wheel_speeds(self, forward: float, turning: float) -> tuple[float, float]:
        """Left and right wheel speed [rad/s], positive forwards.

        Args:
            forward: of the axle's middle [m/s].
            turning: to the left [rad/s].
        """
        half = turning * self.separation / 2
        return (forward - half) / self.wheel_radius, (forward + half) / self.wheel_radius


class WheelOdometry(Struct):
    """Where the wheels say the body is, from where it started."""

    drive: DifferentialDrive
    x: float = 0.0
    """Forwards [m]."""
    y: float = 0.0
    """To the left [m]."""
    yaw: float = 0.0
    """[rad], not wrapped."""

    def update(self, left: float, right: float) -> tuple[float, float]:
        """Add what the wheels turned [rad], positive forwards; return distance [m] and turn [rad].

        The arc is taken along its chord's direction, which is exact for the turn and of third order for the place.
        """
        left, right = left * self.drive.wheel_radius, right * self.drive.wheel_radius
        distance, turn = (left + right) / 2, (right - left) / self.drive.separation
        self.x += distance * math.cos(self.yaw + turn / 2)
        self.y += distance * math.sin(self.yaw + turn / 2)
        self.yaw += turn
        return distance, turn


def step_towards(value: float, target: float, most: float) -> float:
    """Move a value towards a target by no more than `most`."""
    return value + min(max(target - value, -most), most)
