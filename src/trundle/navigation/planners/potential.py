"""A path of least cost down a potential, as in navfn and global_planner."""

import asyncio
import math
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from trundle.navigation import _grids
from trundle.ros import Node

from ..costmap import FREE_SPACE, INSCRIBED, Costmap, CostmapRos
from .interfaces import Plan, Pose2D
from .path_message import path_message

if TYPE_CHECKING:
    from trundle.ros.message_types import nav_msgs


class PotentialPlanner:
    """Plans by a wave front that spreads from the robot, and the path that descends from the goal to the robot.

    The front solves the eikonal equation, so that paths are straight where costs are equal. `~NAME/make_plan` plans
    without driving; each plan is published on `~NAME/plan`.
    """

    def __init__(
        self, node: Node, name: str, costmap: CostmapRos, *, crossing: NDArray[np.float32], tolerance_m: float
    ) -> None:
        """Advertise the plans.

        Args:
            node: node that plans.
            name: namespace of topic and service below the node's.
            costmap: costmap to plan in.
            crossing: (256,) cost of crossing a cell for each cost of the costmap; 0: impassable.
            tolerance_m: default of `make_plan`.
        """
        self._node = node
        self._costmap = costmap
        self._crossing = crossing
        self._tolerance_m = tolerance_m
        self._plans = node.advertise(f"~{name}/plan", "nav_msgs/Path", queue_size=1)
        node.advertise_service(f"~{name}/make_plan", "nav_msgs/GetPlan", self._on_make_plan)

    async def _on_make_plan(self, request: "nav_msgs.GetPlanRequest") -> dict[str, Any]:
        start, goal = (
            Pose2D(pose.pose.position.x, pose.pose.position.y, 0.0) for pose in (request.start, request.goal)
        )
        plan = await self.make_plan(start, goal, request.tolerance)
        if plan is not None:
            self.publish(plan)
        empty = Plan(self._costmap.frame, np.empty((0, 3)))
        return {"plan": path_message(plan or empty, self._node.clock.now_ns())}

    async def make_plan(self, start: Pose2D, goal: Pose2D, tolerance: float | None = None) -> Plan | None:
        """See `GlobalPlanner`; plans with a copy of the costs, in a worker thread."""
        grid = self._costmap.costmap
        first, last = grid.cell(start.x, start.y), grid.cell(goal.x, goal.y)
        if first is None:
            self._node.log.warn(
                "The robot's start position is off the global costmap. Planning will always fail, are you sure the "
                "robot has been properly localized?"
            )
            return None
        if last is None:
            self._node.log.warn(
                "The goal sent to the global planner is off the global costmap. Planning will always fail to this goal."
            )
            return None
        reach = self._tolerance_m if tolerance is None else tolerance
        if not 0.0 <= reach < math.inf:
            reach = 0.0
        return await asyncio.to_thread(self._plan, grid.copy(), start, goal, first, last, reach)

    def publish(self, plan: Plan) -> None:
        """See `GlobalPlanner`."""
        if self._plans.has_subscribers:
            self._plans.publish(path_message(plan, self._node.clock.now_ns()))

    def _plan(
        self, grid: Costmap, start: Pose2D, goal: Pose2D, first: tuple[int, int], last: tuple[int, int], reach: float
    ) -> Plan | None:
        """Plan from the cell `first` to `last`, or to the nearest within reach [m]."""
        costs = self._costs(grid, first)
        potential = _grids.wave_front(costs, [first], stop=last)  # no `last`: the front has reached every cell it can
        end = nearest_reached(potential, last, reach / grid.resolution_m)
        path = _grids.descend(potential, end, first) if end is not None else np.empty((0, 2))
        if end is None or not len(path):
            return None
        return Plan(self._costmap.frame, self._poses(grid, path[::-1], start, goal, is_exact=end == last))

    def _costs(self, grid: Costmap, start: tuple[int, int]) -> NDArray[np.float32]:
        """Return the cost of crossing each cell; the border is impassable, the robot's own cell is not.

        Inscribed cells within the robot's radius can be crossed at the highest cost, so that a robot that came too
        near to an obstacle finds a path away from it.
        """
        costs = self._crossing[grid.cells]
        reach = math.ceil(self._costmap.inscribed_m / grid.resolution_m)
        around = tuple(slice(max(center - reach, 0), center + reach + 1) for center in (start[1], start[0]))
        costs[around][grid.cells[around] == INSCRIBED] = self._crossing.max()
        costs[[0, -1], :] = 0.0
        costs[:, [0, -1]] = 0.0
        costs[start[1], start[0]] = self._crossing[FREE_SPACE]
        return costs

    def _poses(
        self, grid: Costmap, path: NDArray[np.float64], start: Pose2D, goal: Pose2D, *, is_exact: bool
    ) -> NDArray[np.float64]:
        """Return the poses from the robot to the goal [m]; each heads along the path."""
        points = (path + 0.5) * grid.resolution_m + np.array(grid.origin)
        points[0] = start.x, start.y
        if is_exact:
            points[-1] = goal.x, goal.y
        steps = np.diff(points, axis=0, append=points[-1:])
        yaws = np.arctan2(steps[:, 1], steps[:, 0])
        yaws[-1] = goal.yaw
        return np.column_stack([points, yaws])


def nearest_reached(
    potential: NDArray[np.float32], goal: tuple[int, int], tolerance_cells: float
) -> tuple[int, int] | None:
    """Return the cell nearest to the goal that the front reached, within the tolerance; None if there is none."""
    column, row = goal
    if potential[row, column] < _grids.UNREACHED:
        return goal
    reach = math.floor(tolerance_cells)
    x0, y0 = max(column - reach, 0), max(row - reach, 0)
    part = potential[y0 : row + reach + 1, x0 : column + reach + 1]
    rows, columns = np.nonzero(part < _grids.UNREACHED)
    squares = (rows + y0 - row) ** 2 + (columns + x0 - column) ** 2
    if not len(squares) or squares.min() > tolerance_cells**2:
        return None
    nearest = int(squares.argmin())
    return int(columns[nearest]) + x0, int(rows[nearest]) + y0
