"""The robot's velocity from its odometry, and limited changes of it."""

import math
from typing import TYPE_CHECKING

from trundle.ros import Node

if TYPE_CHECKING:
    from trundle.ros.message_types import nav_msgs


class OdometryReader:
    """The latest velocity on an odometry topic."""

    def __init__(self, node: Node, topic: str) -> None:
        self.velocity = (0.0, 0.0, 0.0)
        """x, y [m/s] and yaw [rad/s] of the robot; zero before the first message."""
        node.subscribe(topic, "nav_msgs/Odometry", self._on_odometry, queue_size=1)

    def _on_odometry(self, message: "nav_msgs.Odometry") -> None:
        twist = message.twist.twist
        velocity = (float(twist.linear.x), float(twist.linear.y), float(twist.angular.z))
        if all(math.isfinite(value) for value in velocity):
            self.velocity = velocity


def angle_between(first: float, second: float) -> float:
    """Return the angle from the first to the second direction, −π … π [rad]."""
    return math.remainder(second - first, 2.0 * math.pi)


def approach(value: float, target: float, step: float) -> float:
    """Move a value toward a target by at most a step."""
    return min(value + step, target) if value < target else max(value - step, target)


def turning_speed(
    angle: float, now: float, *, least: float, most: float, acceleration: float, period_s: float, rest_s: float = 0.0
) -> float:
    """Return the speed [rad/s] for a turn on the spot: as fast as allowed, and able to stop at its end.

    Args:
        angle: angle that is left [rad].
        now: present speed [rad/s].
        least: least speed that moves the robot [rad/s].
        most: greatest speed [rad/s].
        acceleration: limit [rad/s²].
        period_s: time until the next command [s].
        rest_s: least time for what is left of the turn [s].
    """
    sign = math.copysign(1.0, angle)
    stopping = math.sqrt(2.0 * acceleration * abs(angle))
    speed = min(most, stopping, abs(angle) / max(period_s, rest_s))
    reachable = max(sign * now + acceleration * period_s, least)
    return sign * max(min(speed, reachable), min(least, most))
