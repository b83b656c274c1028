"""The plan that a local planner follows: the part near the robot, in the local costmap's frame."""

import math

import numpy as np
from numpy.typing import NDArray

from trundle.navigation import _grids
from trundle.ros import Node, TransformBuffer, TransformError

from ..costmap import INSCRIBED, Costmap, CostmapRos
from .interfaces import Plan, Pose2D

_PRUNED_M = 1.0
"""Length of the plan behind the robot that is kept."""
_SEARCHED_M = 2.0
"""Length of the plan ahead in which the robot's place on the plan is searched, so that it does not skip loops."""


class FollowedPlan:
    """A global plan, and how far the robot has come along it."""

    def __init__(self, node: Node, costmap: CostmapRos, buffer: TransformBuffer) -> None:
        self._node = node
        self._costmap = costmap
        self._buffer = buffer
        self._plan: Plan | None = None
        self._place = 0

    def set(self, plan: Plan) -> None:
        """Follow a plan from its start."""
        self._plan, self._place = plan, 0

    def clear(self) -> None:
        """Follow nothing."""
        self._plan = None

    def local(self, pose: Pose2D) -> NDArray[np.float64] | None:
        """Return the plan (n, 3) in the local frame from the robot on, as far as the local costmap reaches.

        None without a plan or a transform; the last pose may be the goal.
        """
        if self._plan is None:
            return None
        poses = self._in_local_frame(self._plan)
        if poses is None or not len(poses):
            return None
        distances = np.hypot(poses[:, 0] - pose.x, poses[:, 1] - pose.y)
        lengths = lengths_along(poses)
        is_searched = (lengths >= lengths[self._place] - _PRUNED_M) & (lengths <= lengths[self._place] + _SEARCHED_M)
        near = np.where(is_searched, distances, np.inf)
        self._place = int(near.argmin())
        grid = self._costmap.costmap
        reach = max(grid.width, grid.height) * grid.resolution_m / 2.0
        beyond = np.nonzero(distances[self._place :] > reach)[0]
        end = self._place + int(beyond[0]) if len(beyond) else len(poses)
        return poses[self._place : max(end, self._place + 1)]

    def goal(self) -> Pose2D | None:
        """Return the plan's last pose in the local frame; None without a plan or a transform."""
        poses = None if self._plan is None else self._in_local_frame(self._plan)
        return None if poses is None or not len(poses) else Pose2D(*poses[-1].tolist())

    def _in_local_frame(self, plan: Plan) -> NDArray[np.float64] | None:
        try:
            pose = self._buffer.lookup_transform(self._costmap.frame, plan.frame).pose
        except TransformError as error:
            self._node.log.error(f"Could not transform the global plan to the frame of the controller: {error}")
            return None
        x, y, yaw = pose.position[0], pose.position[1], pose.rpy[2]
        cosine, sine = math.cos(yaw), math.sin(yaw)
        turned = plan.poses @ np.array([[cosine, sine, 0.0], [-sine, cosine, 0.0], [0.0, 0.0, 1.0]])
        return turned + np.array([x, y, yaw])


def lengths_along(poses: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the length of a path (n, 3) up to each of its poses [m]."""
    steps = np.diff(poses[:, :2], axis=0, prepend=poses[:1, :2])
    return np.cumsum(np.hypot(steps[:, 0], steps[:, 1]))


def point_ahead(plan: NDArray[np.float64], distance_m: float) -> Pose2D:
    """Return the pose of a plan at a distance along it; the last pose if the plan is shorter."""
    index = int(np.searchsorted(lengths_along(plan), distance_m))
    return Pose2D(*plan[min(index, len(plan) - 1)].tolist())


def distance_fields(
    grid: Costmap, plan: NDArray[np.float64], front: tuple[float, float]
) -> tuple[NDArray[np.float32], NDArray[np.float32], NDArray[np.float32]]:
    """Return each cell's distances around obstacles [cells]: to the plan, to its last point on the map, to `front`."""
    cells = np.floor(grid.in_cells(plan[:, :2])).astype(int)
    is_inside = ((cells >= 0) & (cells < np.array([grid.width, grid.height]))).all(axis=1)
    inside = [(int(x), int(y)) for x, y in np.unique(cells[is_inside], axis=0).tolist()]
    last = [(int(x), int(y)) for x, y in cells[is_inside][-1:].tolist()]
    end = np.floor(grid.in_cells(np.array([front])))[0]
    limits = np.array([grid.width - 1, grid.height - 1])
    ahead = [(int(x), int(y)) for x, y in [np.clip(end, 0, limits).tolist()]]
    costs = (grid.cells < INSCRIBED).astype(np.float32)
    for x, y in (*inside, *ahead):  # a plan may touch cells that an obstacle has just blocked
        costs[y, x] = 1.0
    return _grids.wave_front(costs, inside), _grids.wave_front(costs, last), _grids.wave_front(costs, ahead)
