"""A robot without inertia that a local planner drives over a map."""

import logging
import math
from types import SimpleNamespace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from trundle.navigation import _grids
from trundle.navigation.costmap import Costmap
from trundle.navigation.costmap.footprint import radii
from trundle.navigation.costmap.inflation_layer import InflationSettings, inflated_costs
from trundle.navigation.planners import Plan
from trundle.navigation.planners.navfn import crossing_costs
from trundle.robots.parameters import RosParameters
from trundle.spatial import Pose

RESOLUTION = 0.05
_PERIOD_S = 0.1
_PARTS = 10
Place = tuple[float, float, float]


class Drive(NamedTuple):
    """poses (n, 3); velocities (n, 3) as commanded; is_free: the footprint touched nothing."""

    poses: NDArray[np.float64]
    velocities: NDArray[np.float64]
    is_reached: bool
    is_free: bool

    @property
    def tightest_m(self) -> float:
        """Least radius of all turns."""
        turns = np.abs(self.velocities[:, 2]) > 1e-6
        return float(np.min(np.abs(self.velocities[turns, 0] / self.velocities[turns, 2])))


def inflated(cells: NDArray[np.int8], inscribed_m: float) -> Costmap:
    """Return the costmap of a map whose occupied cells are > 0, with its corner at the origin."""
    grid = Costmap(cells.shape[1], cells.shape[0], RESOLUTION, (0.0, 0.0))
    grid.cells[cells > 0] = 254
    costs = inflated_costs(InflationSettings(inflation_radius=0.6, cost_scaling_factor=5.0), RESOLUTION, inscribed_m)
    _grids.inflate(grid.cells, (0, 0, grid.width, grid.height), costs, inflate_unknown=False)
    return grid


def shortest(grid: Costmap, start: Place, goal: Place) -> Plan:
    """Return navfn's path."""
    costs = crossing_costs(allow_unknown=True)[grid.cells]
    first, last = grid.cell(*start[:2]), grid.cell(*goal[:2])
    assert first is not None
    assert last is not None
    costs[first[1], first[0]] = 50.0
    way = _grids.descend(_grids.wave_front(costs, [first], stop=last), last, first)[::-1]
    points = (way + 0.5) * RESOLUTION
    points[0], points[-1] = start[:2], goal[:2]
    steps = np.diff(points, axis=0, append=points[-1:])
    yaws = np.arctan2(steps[:, 1], steps[:, 0])
    yaws[-1] = goal[2]
    return Plan("map", np.column_stack([points, yaws]))


def drive(
    planner: type[Any],
    cells: NDArray[np.int8],
    footprint: NDArray[np.float64],
    parameters: dict[str, Any],
    start: Place,
    goal: Place,
    *,
    limit_s: float = 60.0,
) -> Drive:
    """Plan each second and follow the velocities of each tenth, until the planner says that it is there."""
    log = logging.getLogger("bands")
    clock = SimpleNamespace(time_ns=0)
    clock.now_ns = lambda: clock.time_ns
    node: Any = SimpleNamespace(
        name="/move_base",
        log=SimpleNamespace(warn=log.warning, error=log.error, info=log.info),
        advertise=lambda *_, **__: SimpleNamespace(has_subscribers=False),
        subscribe=lambda *_, **__: None,
        clock=clock,
    )
    grid = inflated(cells, radii(footprint)[0])
    robot = SimpleNamespace(pose=np.array(start))
    costmap: Any = SimpleNamespace(
        costmap=grid,
        footprint=footprint,
        frame="map",
        inscribed_m=radii(footprint)[0],
        robot_pose=lambda: tuple(robot.pose.tolist()),
    )
    odometry: Any = SimpleNamespace(velocity=(0.0, 0.0, 0.0))
    still = Pose.from_rpy(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    buffer: Any = SimpleNamespace(lookup_transform=lambda *_: SimpleNamespace(pose=still))
    section = RosParameters(parameters, "/move_base/Planner")
    root = RosParameters({"controller_frequency": 1.0 / _PERIOD_S}, "/move_base")
    follower = planner(node, "Planner", section, root, costmap, buffer, odometry)
    follower.start()
    poses, velocities, is_free, is_reached = [robot.pose], [], True, False
    for cycle in range(round(limit_s / _PERIOD_S)):
        if cycle % 10 == 0:
            x, y, yaw = robot.pose.tolist()
            follower.set_plan(shortest(grid, (x, y, yaw), goal))
        is_reached = follower.is_goal_reached()
        if is_reached:
            break
        velocity = follower.velocity() or (0.0, 0.0, 0.0)
        velocities.append(velocity)
        odometry.velocity = velocity
        for _ in range(_PARTS):
            c, s = math.cos(robot.pose[2]), math.sin(robot.pose[2])
            x, y, turn = velocity
            robot.pose = robot.pose + _PERIOD_S / _PARTS * np.array([c * x - s * y, s * x + c * y, turn])
            cost = _grids.footprint_cost(grid.cells, grid.origin, RESOLUTION, footprint, tuple(robot.pose.tolist()))
            is_free = is_free and cost >= 0.0
        poses.append(robot.pose)
        clock.time_ns += round(_PERIOD_S * 1e9)
    return Drive(np.array(poses), np.array(velocities), is_reached, is_free)
