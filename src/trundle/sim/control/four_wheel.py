"""Kinematics of four driven, steered wheels, with the commands of four_wheel_steering_controller."""

import math
from typing import TypeAlias

from msgspec import Struct

Wheels: TypeAlias = tuple[float, float, float, float]
"""Front left, front right, rear left, rear right."""
_SLOWEST = 0.001
"""Speed below which the robot is at rest [m/s]."""
_TURNED = 0.001
"""Steering angle below which a wheel points straight on [rad]."""
_SAME = 0.01
"""Difference of the tangents of an axle's angles below which its wheels are parallel."""


class FourWheelSteering(Struct, frozen=True, kw_only=True):
    """Robot with two steered axles."""

    track: float
    """Distance between the steering axes of one axle [m]."""
    offset: float
    """Distance from a steering axis out to its wheel [m]."""
    radius: float
    """Wheel radius [m]."""
    base: float
    """Wheelbase [m]."""

    def command_for_twist(self, forward: float, turning: float) -> tuple[Wheels, Wheels]:
        """Return wheel speeds [rad/s] and steering angles [rad] for a twist, with opposite angles at the two axles.

        Args:
            forward: speed of the centre [m/s].
            turning: yaw rate, positive to the left [rad/s].
        """
        moves, half = abs(forward) > _SLOWEST, turning * self.track / 2
        speeds = (0.0, 0.0)
        if moves:
            speeds = self._speeds(forward, turning, self.base * turning / 2)
        left = right = 0.0
        if abs(forward) > abs(half):
            reach = turning * self.base / 2
            left, right = math.atan(reach / (forward - half)), math.atan(reach / (forward + half))
        elif moves:
            left = right = math.copysign(math.pi / 2, turning)
        return (*speeds, *speeds), (left, right, -left, -right)

    def command_for_angles(self, speed: float, front: float, rear: float) -> tuple[Wheels, Wheels]:
        """Return wheel speeds [rad/s] and steering angles [rad] for given angles at the axles' centres.

        Args:
            speed: speed of the centre along the base [m/s].
            front: front angle, positive to the left [rad].
            rear: rear angle, positive to the left [rad].
        """
        ahead, behind = (math.tan(min(max(angle, -math.pi / 2), math.pi / 2)) for angle in (front, rear))
        difference = self.track * (ahead - behind) / 2
        angles = (0.0, 0.0, 0.0, 0.0)
        if abs(self.base - abs(difference)) > _SLOWEST:
            near, far = self.base - difference, self.base + difference
            fl, fr, rl, rr = (
                math.atan(self.base * tangent / distance) for tangent in (ahead, behind) for distance in (near, far)
            )
            angles = (fl, fr, rl, rr)
        if abs(speed) <= _SLOWEST:
            return (0.0, 0.0, 0.0, 0.0), angles
        turning = speed * (ahead - behind) / self.base
        lengths = (self._to_centre(*angles[:2]), self._to_centre(*angles[2:]))
        front_speeds, rear_speeds = (self._speeds(speed, turning, length * turning) for length in lengths)
        return front_speeds + rear_speeds, angles

    def forward_kinematics(self, speeds: Wheels, front: float, rear: float) -> tuple[float, float, float]:
        """Return the centre's velocity forwards and to the left [m/s], and the yaw rate, positive to the left [rad/s].

        Args:
            speeds: wheel speeds [rad/s].
            front: angle at the front axle's centre [rad].
            rear: angle at the rear axle's centre [rad].
        """
        bend = (math.tan(front) - math.tan(rear)) / self.base
        ahead = self._axle_speed(speeds[:2], front, math.cos(front) * bend)
        behind = self._axle_speed(speeds[2:], rear, math.cos(rear) * bend)
        turning = (ahead * math.cos(front) + behind * math.cos(rear)) * bend / 2
        forward = (ahead * math.cos(front) + behind * math.cos(rear)) / 2
        return forward, (ahead * math.sin(front) + behind * math.sin(rear)) / 2, turning

    def _speeds(self, forward: float, turning: float, sideways: float) -> tuple[float, float]:
        """Return the speeds of an axle's left and right wheel [rad/s], for a lateral speed of its steering
        axes [m/s].
        """
        sign, out, half = math.copysign(1.0, forward), turning * self.offset / self.radius, turning * self.track / 2
        left, right = (sign * math.hypot(forward + rotation, sideways) / self.radius for rotation in (-half, half))
        return left - out, right + out

    def _to_centre(self, left: float, right: float) -> float:
        """Return the distance along the base from an axle to the centre of rotation [m]."""
        one, other = math.tan(left), math.tan(right)
        return one * other * self.track / (one - other) if abs(one - other) > _SAME else 0.0

    def _axle_speed(self, speeds: tuple[float, float], angle: float, curvature: float) -> float:
        """Return the speed of an axle's centre along its angle [m/s], from its wheels [rad/s]."""
        wide = self.track * curvature
        ratios = (math.sqrt(1.0 + sign * wide * math.cos(angle) + wide**2 / 4) for sign in (-1.0, 1.0))
        outward = (-self.offset * curvature, self.offset * curvature)
        left, right = (speed / (1.0 + out / ratio) for speed, out, ratio in zip(speeds, outward, ratios, strict=True))
        return math.copysign(self.radius * math.hypot(left, right) / math.sqrt(2.0 + wide**2 / 2), left + right)


def axle_angle(left: float, right: float) -> float:
    """Return the angle at an axle's centre [rad], from its wheels' angles."""
    one, other = math.tan(left), math.tan(right)
    if (abs(left) <= _TURNED and abs(right) <= _TURNED) or one + other == 0.0:
        return 0.0
    return math.atan(2.0 * one * other / (one + other))
