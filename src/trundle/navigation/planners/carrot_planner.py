"""carrot_planner/CarrotPlanner: straight toward the goal, as far as the footprint fits."""

import math

import numpy as np

from trundle.navigation import _grids
from trundle.robots.parameters import RosParameters
from trundle.ros import Node

from ..costmap import CostmapRos
from .interfaces import Plan, Pose2D


class CarrotPlanner:
    """Plans a straight path to the goal, or to the last pose before the goal where the footprint touches nothing.

    Parameters, with the original's defaults: step_size (the costmap's resolution), min_dist_from_robot 0.1.
    """

    def __init__(self, node: Node, name: str, settings: RosParameters, costmap: CostmapRos) -> None:
        del node, name
        self._costmap = costmap
        self._step_m = settings.number("step_size", costmap.costmap.resolution_m, above=0.0)
        self._least_m = settings.number("min_dist_from_robot", 0.1)

    async def make_plan(self, start: Pose2D, goal: Pose2D, tolerance: float | None = None) -> Plan | None:
        """See `GlobalPlanner`; every tolerance is allowed."""
        del tolerance
        distance = math.hypot(goal.x - start.x, goal.y - start.y)
        shares = np.linspace(0.0, 1.0, max(math.ceil(distance / self._step_m), 1) + 1)
        turn = math.remainder(goal.yaw - start.yaw, 2.0 * math.pi)
        offset = np.array([goal.x - start.x, goal.y - start.y, turn])
        poses = np.array(start) + shares[:, None] * offset
        free = [index for index, pose in enumerate(poses.tolist()) if self._fits(Pose2D(*pose))]
        if not free or shares[free[-1]] * distance < min(self._least_m, distance):
            return None
        return Plan(self._costmap.frame, poses[: free[-1] + 1])

    def publish(self, plan: Plan) -> None:
        """See `GlobalPlanner`; the original has no topic."""

    def _fits(self, pose: Pose2D) -> bool:
        grid = self._costmap.costmap
        cost = _grids.footprint_cost(grid.cells, grid.origin, grid.resolution_m, self._costmap.footprint, pose)
        return cost >= 0.0
