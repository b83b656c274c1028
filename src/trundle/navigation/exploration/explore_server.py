"""frontier_exploration/explore_server: explores what lies within a boundary."""

import asyncio
import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from trundle.gazebo.nodes import NodeHost
from trundle.gazebo.nodes.rate import Rate
from trundle.robots.parameters import ParamError, RosParameters
from trundle.ros import (
    ABORTED,
    ActionClient,
    ActionResult,
    ActionServer,
    Node,
    ServiceError,
    TransformError,
    TransformListener,
)

from ..costmap import BoundedExploreLayer, CostmapRos
from .frontier import Frontier, Point, find_frontiers, is_inside

_RETRIES = 5
_POLL_S = 0.1


class ExploreServer:
    """Drives to frontiers within a boundary. The action is NODE_NAME, a frontier_exploration/ExploreTask.

    Parameters, with the original's defaults: frequency 0 (a new goal only when the last one ended), goal_aliasing
    0.1, and the namespace explore_costmap with a BoundedExploreLayer. Services of that layer: get_next_frontier and
    update_boundary_polygon.
    """

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node
        self._next: dict[str, Any] = {}
        """Goal pose at the present frontier."""

    async def run(self) -> int:
        """Serve until cancelled."""
        node = self._node
        try:
            root = RosParameters(await node.params.get("~", {}), node.name, warn=node.log.warn)
            self._frequency_hz = root.number("frequency", 0.0, minimum=0.0)
            self._aliasing_m = root.number("goal_aliasing", 0.1, minimum=0.0)
            self._buffer = TransformListener(node).buffer
            self._costmap = CostmapRos(node, "explore_costmap", root, self._buffer)
            self._layer = self._find_layer(root)
        except ParamError as error:
            node.log.fatal(str(error))
            return 1
        space = f"~explore_costmap/{self._layer.name}"
        kind = "frontier_exploration/UpdateBoundaryPolygon"
        node.advertise_service(f"{space}/update_boundary_polygon", kind, self._on_boundary)
        node.advertise_service(f"{space}/get_next_frontier", "frontier_exploration/GetNextFrontier", self._on_frontier)
        self._client = ActionClient(node, "move_base", "move_base_msgs/MoveBase")
        await self._costmap.start()
        self._server = ActionServer(node, node.name, "frontier_exploration/ExploreTask", self._execute)
        await node.closed.wait()
        return 0

    def _find_layer(self, root: RosParameters) -> BoundedExploreLayer:
        layer = next((layer for layer in self._costmap.layers if isinstance(layer, BoundedExploreLayer)), None)
        if layer is None:
            raise ParamError(
                f"{root.namespace}/explore_costmap has no plugin frontier_exploration::BoundedExploreLayer"
            )
        points = ("closest", "middle", "centroid")
        if layer.options.frontier_travel_point not in points:
            self._node.log.error(
                f"{root.namespace}: frontier_travel_point {layer.options.frontier_travel_point!r} is none of "
                f"{', '.join(points)}; closest is used"
            )
            layer.options.frontier_travel_point = "closest"
        return layer

    # -- services

    def _on_boundary(self, request: Any) -> dict[str, Any]:
        self._set_boundary(self._in_costmap(request.explore_boundary))
        return {}

    async def _on_frontier(self, request: Any) -> dict[str, Any]:
        position = request.start_pose.pose.position
        pose = await self._next_pose((position.x, position.y))
        if pose is None:
            raise ServiceError("there is no frontier")
        return {"next_frontier": pose}

    def _set_boundary(self, polygon: NDArray[np.float64]) -> None:
        self._layer.set_boundary(polygon)
        self._costmap.match_size()
        self._costmap.update()

    def _in_costmap(self, message: Any) -> NDArray[np.float64]:
        """Return a PolygonStamped's corners (n, 2) in the costmap's frame [m].

        Raises:
            TransformError: its frame is not known.
        """
        corners = [(float(point.x), float(point.y)) for point in message.polygon.points]
        moved = [self._point_in_costmap(message.header.frame_id, corner) for corner in corners]
        return np.array(moved, dtype=np.float64).reshape(-1, 2)

    def _point_in_costmap(self, frame: str, point: Point) -> Point:
        frame = frame.lstrip("/") or self._costmap.frame
        if frame == self._costmap.frame:
            return point
        pose = self._buffer.lookup_transform(self._costmap.frame, frame).pose
        x, y, _ = pose.transform_point((*point, 0.0))
        return x, y

    # -- the action

    async def _execute(self, goal: Any, accept: Any) -> ActionResult:
        accept()
        try:
            self._costmap.reset()
            center = goal.explore_center
            self._center = self._point_in_costmap(center.header.frame_id, (center.point.x, center.point.y))
            self._polygon = self._in_costmap(goal.explore_boundary)
            self._set_boundary(self._polygon)
        except (TransformError, ValueError) as error:
            self._node.log.error(f"the boundary is not used: {error}")
            return ActionResult(status="aborted", text=str(error))
        while not self._client.has_server:
            await self._node.clock.sleep(_POLL_S)
        try:
            return await self._explore()
        finally:
            self._client.cancel()

    async def _explore(self) -> ActionResult:
        retries, has_explored = _RETRIES, False
        rate = Rate(self._node, self._frequency_hz or 1.0 / _POLL_S)
        self._target: Point | None = None
        self._has_failed = False
        while not self._has_failed:
            robot = self._costmap.robot_pose()
            if robot is None:
                await self._node.clock.sleep(_POLL_S)
                continue
            place = (robot[0], robot[1])
            if len(self._polygon) and not is_inside(self._polygon, *place):
                pose: dict[str, Any] | None = self._pose(place, self._center)
            else:
                pose = await self._next_pose(place)
                has_explored |= pose is not None
                retries = _RETRIES if pose is not None else retries - 1
            if pose is not None:
                self._send(pose)
            elif retries < 0:
                text = "Finished exploring room" if has_explored else "Failed exploration"
                self._node.log.warn(text)
                return ActionResult(status="succeeded" if has_explored else "aborted", text=text)
            await rate.sleep()
            while self._frequency_hz == 0.0 and self._target is not None and not self._has_failed:
                await self._node.clock.sleep(_POLL_S)
        self._node.log.error("Failed to move")
        return ActionResult(status="aborted", text="Failed to move")

    async def _next_pose(self, robot: Point) -> dict[str, Any] | None:
        """Return the pose at the nearest frontier."""
        costmap = self._costmap.costmap.copy()
        with self._node.loop.work.pending("the frontiers"):
            found = await asyncio.to_thread(find_frontiers, costmap, robot)
        if not found:
            return None
        nearest = min(found, key=lambda frontier: frontier.distance_m)
        return self._pose(robot, self._travel_point(nearest))

    def _travel_point(self, frontier: Frontier) -> Point:
        kind = self._layer.options.frontier_travel_point
        return frontier.initial if kind == "closest" else frontier.middle if kind == "middle" else frontier.centroid

    def _pose(self, robot: Point, target: Point) -> dict[str, Any]:
        """Return the pose at a point, with the heading from the robot to there."""
        yaw = math.atan2(target[1] - robot[1], target[0] - robot[0])
        header = {"stamp": self._node.clock.now_ns(), "frame_id": self._costmap.frame}
        orientation = {"z": math.sin(yaw / 2.0), "w": math.cos(yaw / 2.0)}
        position = {"x": target[0], "y": target[1]}
        return {"header": header, "pose": {"position": position, "orientation": orientation}}

    def _send(self, pose: dict[str, Any]) -> None:
        """Send a goal, unless it is near the last one."""
        position = pose["pose"]["position"]
        target = (position["x"], position["y"])
        if self._target is not None and math.dist(target, self._target) < 0.5 * self._aliasing_m:
            return
        self._target, self._next = target, pose
        self._client.send({"target_pose": pose}, self._on_end, self._on_feedback)

    def _on_end(self, state: int) -> None:
        self._target = None
        self._has_failed = state == ABORTED

    def _on_feedback(self, feedback: Any) -> None:
        self._server.publish_feedback({"next_frontier": self._next, "base_position": feedback.base_position})
