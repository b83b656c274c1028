"""Differential drive: body twist to wheel speeds, and wheel odometry."""

import math

from msgspec import Struct


class DifferentialDrive(Struct, frozen=True, kw_only=True):
    """Differential drive with two wheels on one axle."""

    wheel_radius: float
    """[m]"""
    separation: float
    """Distance between the wheels' centres [m]."""

    def wheel_speeds(self, forward: float, turning: float) -> tuple[float, float]:
        """Return left and right wheel speed [rad/s], positive forwards.

        Args:
            forward: speed of the axle's centre [m/s].
            turning: yaw rate, positive to the left [rad/s].
        """
        half = turning * self.separation / 2
        return (forward - half) / self.wheel_radius, (forward + half) / self.wheel_radius


class WheelOdometry(Struct):
    """Planar odometry from wheel rotation, relative to the start."""

    drive: DifferentialDrive
    x: float = 0.0
    """Position forwards [m]."""
    y: float = 0.0
    """Position to the left [m]."""
    yaw: float = 0.0
    """Yaw [rad], not wrapped."""

    def update(self, left: float, right: float) -> tuple[float, float]:
        """Add wheel rotations [rad], positive forwards; return distance [m] and change of yaw [rad].

        The arc is replaced by a chord along the mean heading: exact in yaw, third-order in position.
        """
        left, right = left * self.drive.wheel_radius, right * self.drive.wheel_radius
        distance, turn = (left + right) / 2, (right - left) / self.drive.separation
        self.x += distance * math.cos(self.yaw + turn / 2)
        self.y += distance * math.sin(self.yaw + turn / 2)
        self.yaw += turn
        return distance, turn


def step_towards(value: float, target: float, max_step: float) -> float:
    """Move a value towards a target by at most `max_step`."""
    return value + min(max(target - value, -max_step), max_step)
