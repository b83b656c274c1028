"""Base of local planners: the plan's part near the robot, the end of the plan, turns on the spot, topics."""

import math
from abc import ABC, abstractmethod
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from trundle.navigation import _grids
from trundle.robots.parameters import RosParameters
from trundle.ros import Node, Publisher, TransformBuffer

from ..costmap import CostmapRos
from .followed_plan import FollowedPlan, point_ahead
from .goal_stop import GoalStop, StopLimits, Velocity
from .interfaces import Plan, Pose2D
from .motion import OdometryReader, angle_between, turning_speed
from .oscillation import OscillationFlags
from .path_message import path_message

_TURN_FIRST, _TURN_ENOUGH = math.radians(60.0), math.radians(15.0)
"""Angles to the path: above the first the robot turns on the spot, below the second it drives on."""
_TURN_LOOKAHEAD_M = 0.3
_SLOW_TURN = 0.3
"""Turning speed below which the robot drives on after a turn [rad/s]."""


class Follower(ABC):
    """A local planner; subclasses choose the velocity along the path."""

    def __init__(
        self,
        node: Node,
        name: str,
        parameters: Sequence[RosParameters],
        limits: StopLimits,
        costmap: CostmapRos,
        buffer: TransformBuffer,
        odom: OdometryReader,
        *,
        stopped_speed: float,
        stopped_turn: float,
    ) -> None:
        """Read `controller_frequency`, and advertise the plans.

        Args:
            node: node that publishes.
            name: namespace of the planner's topics below the node's.
            parameters: the planner's own, then others; `controller_frequency` is the first one found.
            limits: tolerances and accelerations.
            costmap: local costmap.
            buffer: transforms.
            odom: the robot's velocity.
            stopped_speed: greatest speed of a robot that stands [m/s].
            stopped_turn: greatest turning speed of a robot that stands [rad/s].
        """
        self.node = node
        self.costmap = costmap
        self.odom = odom
        space = next((space for space in parameters if "controller_frequency" in space), parameters[0])
        self.period_s = 1.0 / space.number("controller_frequency", 20.0, above=0.0)
        """Time until the next command [s]."""
        self.oscillation = OscillationFlags()
        self._limits = limits
        self._plan = FollowedPlan(node, costmap, buffer)
        self._stop = GoalStop(node, limits, stopped_speed=stopped_speed, stopped_turn=stopped_turn)
        self._is_turning = False
        self._global = node.advertise(f"~{name}/global_plan", "nav_msgs/Path", queue_size=1)
        self._local = node.advertise(f"~{name}/local_plan", "nav_msgs/Path", queue_size=1)

    @property
    @abstractmethod
    def turn_limits(self) -> tuple[float, float]:
        """Least and greatest speed of a turn on the spot [rad/s]."""

    @property
    @abstractmethod
    def turns_first(self) -> bool:
        """True if the robot turns on the spot before it drives."""

    @abstractmethod
    def rollout_settings(self, time_s: float) -> _grids.RolloutSettings:
        """Return the settings to simulate trajectories of a duration."""

    @abstractmethod
    def best(self, pose: Pose2D, plan: NDArray[np.float64]) -> Velocity | None:
        """Return the best velocity along a path (n, 3) in the local frame; None if all collide."""

    def horizon_s(self, pose: Pose2D, plan: NDArray[np.float64], speed: float, time_s: float) -> float:
        """Return the time to simulate: at most `time_s`, and no longer than the path takes at a speed [m/s].

        Otherwise the best trajectory would be the one that ends at the goal after exactly `time_s`, and the robot
        would creep toward the goal.
        """
        distance = math.hypot(plan[-1, 0] - pose.x, plan[-1, 1] - pose.y)
        return min(time_s, max(distance / max(speed, 1e-3), 2.0 * self.period_s))

    def start(self) -> None:
        """See `LocalPlanner`."""
        self._stop.reset(is_new_goal=True)
        self.oscillation.reset()
        self._is_turning = False

    def set_plan(self, plan: Plan) -> None:
        """See `LocalPlanner`."""
        self._plan.set(plan)

    def is_goal_reached(self) -> bool:
        """See `LocalPlanner`."""
        pose, goal = self.costmap.robot_pose(), self._plan.goal()
        if pose is None or goal is None or not self._stop.is_reached(Pose2D(*pose), goal, self.odom.velocity):
            return False
        self.node.log.info("Goal reached")
        return True

    def velocity(self) -> Velocity | None:
        """See `LocalPlanner`."""
        found = self.costmap.robot_pose()
        if found is None:
            self.node.log.error("Could not get robot pose")
            return None
        pose = Pose2D(*found)
        plan, goal = self._plan.local(pose), self._plan.goal()
        if plan is None or goal is None:
            self.node.log.error("Could not get local plan")
            return None
        self._publish(self._global, plan)
        command = self._choose(pose, plan, goal)
        if self._local.has_subscribers:
            path = [] if command is None else self._rolled_out(pose, command, None)
            self._publish(self._local, np.array(path).reshape(-1, 3))
        return command

    def _choose(self, pose: Pose2D, plan: NDArray[np.float64], goal: Pose2D) -> Velocity | None:
        least, most = self.turn_limits
        if self._stop.has_arrived(pose, goal, self.odom.velocity):
            return self._stop.command(
                pose,
                goal,
                self.odom.velocity,
                least_turn=least,
                most_turn=most,
                period_s=self.period_s,
                is_free=lambda velocity: self._is_free(pose, velocity, self.period_s),
            )
        turn = self._turn_first(pose, plan) if self.turns_first else None
        return self.best(pose, plan) if turn is None else turn

    def _rolled_out(self, pose: Pose2D, velocity: Velocity, time_s: float | None) -> list[tuple[float, float, float]]:
        return _grids.roll_out(self.rollout_settings(time_s or 1.0), pose, self.odom.velocity, velocity)

    def _is_free(self, pose: Pose2D, velocity: Velocity, time_s: float) -> bool:
        """True if the footprint touches nothing along a velocity's trajectory."""
        grid = self.costmap.costmap
        return all(
            _grids.footprint_cost(grid.cells, grid.origin, grid.resolution_m, self.costmap.footprint, point) >= 0.0
            for point in self._rolled_out(pose, velocity, time_s)
        )

    def _turn_first(self, pose: Pose2D, plan: NDArray[np.float64]) -> Velocity | None:
        """Return a turn on the spot toward a path that begins beside or behind the robot; None: drive."""
        ahead = point_ahead(plan, _TURN_LOOKAHEAD_M)
        if math.hypot(ahead.x - pose.x, ahead.y - pose.y) <= self._limits.xy_goal_tolerance:
            self._is_turning = False
            return None
        angle = angle_between(pose.yaw, math.atan2(ahead.y - pose.y, ahead.x - pose.x))
        least, most = self.turn_limits
        now, acceleration = self.odom.velocity[2], self._limits.acc_lim_theta
        if self._is_turning and abs(angle) <= _TURN_ENOUGH:
            self._is_turning = abs(now) > _SLOW_TURN
            return (0.0, 0.0, 0.0) if self._is_turning else None
        self._is_turning = self._is_turning or abs(angle) > _TURN_FIRST
        if not self._is_turning:
            return None
        speed = turning_speed(angle, now, least=least, most=most, acceleration=acceleration, period_s=self.period_s)
        turn = (0.0, 0.0, speed)
        return turn if self._is_free(pose, turn, abs(angle / speed)) else None

    def _publish(self, publisher: Publisher, poses: NDArray[np.float64]) -> None:
        if publisher.has_subscribers:
            publisher.publish(path_message(Plan(self.costmap.frame, poses), self.node.clock.now_ns()))
