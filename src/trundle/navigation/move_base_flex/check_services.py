"""Services of mbf_costmap_nav that look at its costmaps."""

import asyncio
from functools import partial
from typing import Any

import numpy as np

from trundle.ros import Node, TransformBuffer, TransformError

from ..costmap import CostmapRos
from ..pose_messages import from_planar, planar, pose_fields, read_pose
from .cost_checks import FREE, OUTSIDE, Multipliers, find_pose, path_cells_state, point_state, pose_state

_LOCAL = 1
_MAX_MARGIN_M = 100.0


class CheckServices:
    """`~check_point_cost`, `~check_pose_cost`, `~check_path_cost`, `~find_valid_pose`, `~clear_costmaps`."""

    def __init__(
        self, node: Node, global_costmap: CostmapRos, local_costmap: CostmapRos, buffer: TransformBuffer
    ) -> None:
        self._node = node
        self._global = global_costmap
        self._local = local_costmap
        self._buffer = buffer
        node.advertise_service("~check_point_cost", "mbf_msgs/CheckPoint", self._check_point)
        node.advertise_service("~check_pose_cost", "mbf_msgs/CheckPose", self._check_pose)
        node.advertise_service("~check_path_cost", "mbf_msgs/CheckPath", self._check_path)
        node.advertise_service("~find_valid_pose", "mbf_msgs/FindValidPose", self._find_pose)
        node.advertise_service("~clear_costmaps", "std_srvs/Empty", self._clear)

    def _clear(self, _request: Any) -> dict[str, Any]:
        self._local.reset()
        self._global.reset()
        return {}

    def _costmap(self, request: Any) -> CostmapRos:
        return self._local if request.costmap == _LOCAL else self._global

    def _place(self, costmap: CostmapRos, pose: Any, frame: str) -> tuple[float, float, float]:
        """Return x, y, yaw of a message's pose in a costmap's frame; raises as its parts do."""
        found, frame = read_pose(pose), frame.lstrip("/")
        if frame and frame != costmap.frame:
            found = self._buffer.lookup_transform(costmap.frame, frame).pose @ found
        return planar(found)

    def _check_point(self, request: Any) -> dict[str, Any]:
        costmap, point, frame = self._costmap(request), request.point.point, request.point.header.frame_id.lstrip("/")
        x, y = float(point.x), float(point.y)
        if frame and frame != costmap.frame:
            try:
                x, y, _ = self._buffer.lookup_transform(costmap.frame, frame).pose.transform_point((x, y, 0.0))
            except TransformError as error:
                self._node.log.error(f"check_point_cost: {error}")
                return {"state": OUTSIDE}
        state, cost = point_state(costmap.costmap, x, y)
        return {"state": state, "cost": cost}

    def _asked_pose(self, service: str, costmap: CostmapRos, request: Any) -> tuple[float, float, float] | None:
        """Return the pose of a request, or the robot's, in a costmap's frame; None, and a line in the log: unknown."""
        try:
            if request.current_pose:
                return costmap.robot_pose()
            return self._place(costmap, request.pose.pose, request.pose.header.frame_id)
        except (TransformError, ValueError) as error:
            self._node.log.error(f"{service}: {error}")
            return None

    def _check_pose(self, request: Any) -> dict[str, Any]:
        costmap = self._costmap(request)
        pose = self._asked_pose("check_pose_cost", costmap, request)
        if pose is None:
            return {"state": OUTSIDE}
        state, cost = pose_state(costmap.costmap, costmap.footprint, pose, _margin(request), _multipliers(request))
        return {"state": state, "cost": cost}

    async def _find_pose(self, request: Any) -> dict[str, Any]:
        """Look beside the graph's thread, in a copy of the costmap; footprints are always padded."""
        costmap = self._costmap(request)
        pose = self._asked_pose("find_valid_pose", costmap, request)
        if pose is None:
            return {"state": OUTSIDE}
        reach_m, turn = (
            min(max(0.0, float(value)), _MAX_MARGIN_M) for value in (request.dist_tolerance, request.angle_tolerance)
        )
        look = partial(find_pose, costmap.costmap.copy(), costmap.footprint, pose, _margin(request))
        state, cost, found = await asyncio.to_thread(look, reach_m=reach_m, turn=turn)
        header = {"frame_id": costmap.frame, "stamp": self._node.clock.now_ns()}
        stamped = {"header": header, "pose": pose_fields(from_planar(*found))}
        return {"state": state, "cost": cost, "pose": stamped}

    def _check_path(self, request: Any) -> dict[str, Any]:
        """Check poses until one has the state `return_on`."""
        costmap, scale = self._costmap(request), _multipliers(request)
        frame = request.path.header.frame_id
        worst, total, last = FREE, 0, 0
        for index in range(0, len(request.path.poses), int(request.skip_poses) + 1):
            try:
                pose = self._place(costmap, request.path.poses[index].pose, frame)
            except (TransformError, ValueError) as error:
                self._node.log.error(f"check_path_cost: {error}")
                return {"state": OUTSIDE, "last_checked": index}
            if request.path_cells_only:
                state, cost = path_cells_state(costmap.costmap, np.array([pose]), scale)
            else:
                state, cost = pose_state(costmap.costmap, costmap.footprint, pose, _margin(request), scale)
            worst, total, last = max(worst, state), min(total + cost, 2**32 - 1), index
            if request.return_on and state >= request.return_on:
                break
        return {"state": worst, "cost": total, "last_checked": last}


def _margin(request: Any) -> float:
    """Return `safety_dist` within bounds [m]; 0 if it is no number."""
    return min(max(0.0, float(request.safety_dist)), _MAX_MARGIN_M)


def _multipliers(request: Any) -> Multipliers:
    return Multipliers(
        float(request.lethal_cost_mult), float(request.inscrib_cost_mult), float(request.unknown_cost_mult)
    )
