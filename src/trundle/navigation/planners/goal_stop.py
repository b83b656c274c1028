"""The end of the plan: stop, and turn to the goal's direction; base_local_planner's LatchedStopRotateController."""

import math
from collections.abc import Callable
from typing import Protocol

from trundle.ros import Node

from .interfaces import Pose2D
from .motion import angle_between, approach, turning_speed


class StopLimits(Protocol):
    """Parameters of the stop at the goal."""

    xy_goal_tolerance: float
    yaw_goal_tolerance: float
    latch_xy_goal_tolerance: bool
    acc_lim_x: float
    acc_lim_y: float
    acc_lim_theta: float


Velocity = tuple[float, float, float]
_LEAVING = 1.5
"""Distance at which a robot that turns at the goal has left it, in tolerances: meanwhile its localization moves."""

_NEARER_M = 1e-3
"""Distance by which a robot comes nearer to the goal with each command until it has arrived [m]."""
_PIVOT_M = 0.3
"""Distance up to which a turn's center may be before or behind the origin, which then moves sideways [m]."""
_REST_S = 1.0
"""Least time for what is left of a turn, once a turn has passed its end [s]; the original's of every turn."""


class GoalStop:
    """Stops within the tolerance of the goal, then turns on the spot.

    It learns two traits of a robot. A turn that takes it out of the tolerance is about a point beside its origin: from
    then on it stops at the goal, not where the tolerance begins. A turn that passes its end is of a base that
    accelerates slower than its limits say, or obeys late: from then on turns end slowly.
    """

    def __init__(self, node: Node, limits: StopLimits, *, stopped_speed: float, stopped_turn: float) -> None:
        """Take the limits.

        Args:
            node: node that logs.
            limits: tolerances and accelerations.
            stopped_speed: greatest speed of a robot that stands [m/s].
            stopped_turn: greatest turning speed of a robot that stands [rad/s].
        """
        self._node = node
        self._limits = limits
        self._stopped_speed = stopped_speed
        self._stopped_turn = stopped_turn
        self._is_latched = False
        self._has_turned = False
        self._nearest_m = math.inf
        self._drifts = self._swings = False
        """Whether a turn took the robot away from the goal, and whether one passed its end."""
        self._angle = 0.0
        """Angle from the robot's direction to the goal's at the last command [rad]."""

    def reset(self, *, is_new_goal: bool) -> None:
        """Begin a plan."""
        self._has_turned = False
        self._nearest_m, self._angle = math.inf, 0.0
        if is_new_goal or not self._limits.latch_xy_goal_tolerance:
            self._is_latched = False

    def has_arrived(self, pose: Pose2D, goal: Pose2D, velocity: Velocity) -> bool:
        """True at the goal's position; of a robot that a turn moves, once it has to brake, or comes no nearer."""
        if not self.is_at_position(pose, goal):
            self._nearest_m = math.inf
            return False
        if not self._drifts:
            return True
        distance = math.hypot(goal.x - pose.x, goal.y - pose.y)
        speed = math.hypot(velocity[0], velocity[1])
        braking = speed**2 / (2.0 * max(self._limits.acc_lim_x, 1e-3))
        has_arrived = self._has_turned or distance <= braking or distance >= self._nearest_m - _NEARER_M
        self._nearest_m = -math.inf if has_arrived else distance
        return has_arrived

    def is_at_position(self, pose: Pose2D, goal: Pose2D) -> bool:
        """True within the tolerance of the goal's position; with a latch, from the first time on.

        A robot that has begun to turn there is at the position until it has left it: its wheels hold it where it was.
        """
        distance, tolerance = math.hypot(goal.x - pose.x, goal.y - pose.y), self._limits.xy_goal_tolerance
        self._drifts = self._drifts or (self._has_turned and distance > _LEAVING * tolerance)
        self._has_turned = self._has_turned and distance <= _LEAVING * tolerance
        is_near = distance <= tolerance or self._has_turned
        if is_near and self._limits.latch_xy_goal_tolerance:
            self._is_latched = True
        return is_near or self._is_latched

    def is_reached(self, pose: Pose2D, goal: Pose2D, velocity: Velocity) -> bool:
        """True if the robot stands at the goal."""
        angle = angle_between(pose.yaw, goal.yaw)
        is_there = self.is_at_position(pose, goal) and abs(angle) <= self._limits.yaw_goal_tolerance
        return is_there and self._stands(velocity)

    def _stands(self, velocity: Velocity) -> bool:
        x, y, turn = velocity
        return abs(turn) <= self._stopped_turn and abs(x) <= self._stopped_speed and abs(y) <= self._stopped_speed

    def command(
        self,
        pose: Pose2D,
        goal: Pose2D,
        velocity: Velocity,
        *,
        least_turn: float,
        most_turn: float,
        period_s: float,
        is_free: Callable[[Velocity], bool],
    ) -> Velocity | None:
        """Return the velocity that stops or turns; None if the footprint would collide."""
        limits = self._limits
        angle = angle_between(pose.yaw, goal.yaw)
        if abs(angle) <= limits.yaw_goal_tolerance:
            return 0.0, 0.0, 0.0
        x, y, turn = velocity
        is_braked = abs(x) <= self._stopped_speed and abs(y) <= self._stopped_speed + _PIVOT_M * abs(turn)
        self._has_turned = self._has_turned or is_braked
        self._swings = self._swings or (angle * self._angle < 0.0 and abs(angle) < math.pi / 2.0)
        self._angle = angle
        speed = turning_speed(
            angle,
            turn,
            least=least_turn,
            most=most_turn,
            acceleration=limits.acc_lim_theta,
            period_s=period_s,
            rest_s=_REST_S if self._swings else 0.0,
        )
        # It brakes while it begins to turn: what it still drives is less than the tolerance.
        step_x, step_y = limits.acc_lim_x * period_s, limits.acc_lim_y * period_s
        rotation = (approach(x, 0.0, step_x), approach(y, 0.0, step_y), speed)
        return rotation if is_free(rotation) else None
