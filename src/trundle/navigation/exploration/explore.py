"""explore_lite/explore: drives the robot to frontiers until there are none."""

import asyncio
import math
from typing import Annotated, Any

from msgspec import Meta, Struct

from trundle.gazebo.nodes import NodeHost
from trundle.gazebo.nodes.private_parameters import private_parameters
from trundle.gazebo.nodes.rate import LogThrottle, Rate
from trundle.robots.parameters import ParamError
from trundle.ros import ABORTED, ActionClient, Node, TransformError, TransformListener
from trundle.spatial import NS_PER_S

from ..settings import read_settings
from .costmap_listener import CostmapListener
from .frontier import Frontier, Point, find_frontiers

_POLL_S = 0.1
_TOLERANCE_CELLS = 5.0
"""Distance below which two goals count as the same, as in the original [m]."""
_BLUE, _RED, _GREEN = (
    {"b": 1.0, "a": 1.0},
    {"r": 1.0, "a": 1.0},
    {"g": 1.0, "a": 1.0},
)
_POINTS, _SPHERE, _DELETE = 8, 2, 2


class ExploreSettings(Struct):
    """Lengths [m], times [s]."""

    robot_base_frame: str = "base_link"
    costmap_topic: str = "costmap"
    costmap_updates_topic: str = "costmap_updates"
    visualize: bool = False
    planner_frequency: Annotated[float, Meta(ge=0.001, le=1000.0)] = 1.0
    progress_timeout: Annotated[float, Meta(ge=0.0, le=1e6)] = 30.0
    potential_scale: float = 0.001
    orientation_scale: float = 0.0
    gain_scale: float = 1.0
    transform_tolerance: float = 0.3
    min_frontier_size: Annotated[float, Meta(ge=0.0, le=1e6)] = 0.5


class Explore:
    """Sends the centroids of frontiers to `move_base` as goals.

    Parameters, with the original's names and defaults: `ExploreSettings`. A frontier's cost is potential_scale times
    its distance, minus gain_scale times its size. A frontier that move_base cannot reach, or toward which it makes no
    progress for progress_timeout, is given up. With visualize, `~frontiers` shows the frontiers. Without frontiers
    the node stops sending goals.
    """

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node
        self._goal: Point | None = None
        self._distance_m = math.inf
        self._progress_ns = 0
        self._refused: list[Point] = []
        self._marker_count = 0
        self._is_due = asyncio.Event()
        """Set when a goal ended: the next one is sent at once."""

    async def run(self) -> int:
        """Explore until cancelled."""
        node = self._node
        try:
            settings = self._settings = read_settings(ExploreSettings, await private_parameters(node))
        except ParamError as error:
            node.log.fatal(str(error))
            return 1
        self._base = settings.robot_base_frame.lstrip("/")
        self._buffer = TransformListener(node).buffer
        self._maps = CostmapListener(node, settings.costmap_topic, settings.costmap_updates_topic)
        self._client = ActionClient(node, "move_base", "move_base_msgs/MoveBase")
        kind = "visualization_msgs/MarkerArray"
        self._markers = node.advertise("~frontiers", kind, queue_size=10) if settings.visualize else None
        await self._wait()
        rate = Rate(node, settings.planner_frequency)
        while not node.closed.is_set() and await self._plan():
            pause = asyncio.ensure_future(rate.sleep())
            due = asyncio.ensure_future(self._is_due.wait())
            _, pending = await asyncio.wait({pause, due}, return_when=asyncio.FIRST_COMPLETED)
            for task in pending:
                task.cancel()
            self._is_due.clear()
        self._client.cancel()
        node.log.info("Exploration stopped.")
        await node.closed.wait()
        return 0

    async def _wait(self) -> None:
        """Wait for a costmap, the robot's pose and move_base."""
        warnings = LogThrottle(self._node, 5.0)
        while not self._node.closed.is_set():
            missing = self._missing()
            if not missing:
                return
            warnings.warn(f"waiting for {missing}")
            await self._node.clock.sleep(_POLL_S)

    def _missing(self) -> str:
        if self._maps.costmap is None:
            return f"a costmap on {self._node.resolve(self._settings.costmap_topic)}"
        if self._robot() is None:
            return f"the transform from {self._base} to {self._maps.frame}"
        return "" if self._client.has_server else "move_base"

    def _robot(self) -> Point | None:
        try:
            x, y, _ = self._buffer.lookup_transform(self._maps.frame, self._base).pose.position
        except TransformError:
            return None
        return x, y

    async def _plan(self) -> bool:
        """Choose a frontier and send it; False: there are none left."""
        costmap, robot, settings = self._maps.costmap, self._robot(), self._settings
        if costmap is None or robot is None:
            return True
        with self._node.loop.work.pending("the frontiers"):
            found = await asyncio.to_thread(find_frontiers, costmap, robot, min_size_m=settings.min_frontier_size)
        found.sort(key=lambda frontier: self._cost(frontier, costmap.resolution_m))
        self._show(found, costmap.resolution_m)
        for frontier in found:
            if self._is_refused(frontier.centroid, costmap.resolution_m):
                continue
            if self._has_progress(frontier):
                self._send(frontier.centroid)
                return True
            self._node.log.info("no progress toward a frontier; it is given up")
            self._refused.append(frontier.centroid)
        return False

    def _cost(self, frontier: Frontier, resolution_m: float) -> float:
        settings = self._settings
        potential = settings.potential_scale * frontier.distance_m
        return (potential - settings.gain_scale * frontier.size) * resolution_m

    def _is_refused(self, goal: Point, resolution_m: float) -> bool:
        limit = _TOLERANCE_CELLS * resolution_m
        return any(abs(goal[0] - x) < limit and abs(goal[1] - y) < limit for x, y in self._refused)

    def _has_progress(self, frontier: Frontier) -> bool:
        """Return True if the goal is new, or was approached within the timeout."""
        now_ns = self._node.clock.now_ns()
        if frontier.centroid != self._goal or self._distance_m > frontier.distance_m:
            self._progress_ns, self._distance_m = now_ns, frontier.distance_m
        return now_ns - self._progress_ns <= self._settings.progress_timeout * NS_PER_S

    def _send(self, goal: Point) -> None:
        if goal == self._goal:
            return
        self._goal = goal
        header = {"stamp": self._node.clock.now_ns(), "frame_id": self._maps.frame}
        pose = {"position": {"x": goal[0], "y": goal[1]}, "orientation": {"w": 1.0}}
        self._client.send({"target_pose": {"header": header, "pose": pose}}, lambda state: self._end(goal, state))

    def _end(self, goal: Point, state: int) -> None:
        """Choose the next goal; the frontier of an aborted goal is given up."""
        if state == ABORTED:
            self._refused.append(goal)
        self._goal = None
        self._is_due.set()

    def _show(self, frontiers: list[Frontier], resolution_m: float) -> None:
        if self._markers is None:
            return
        header = {"stamp": self._node.clock.now_ns(), "frame_id": self._maps.frame}
        common = {"header": header, "ns": "frontiers", "frame_locked": True}
        costs = [self._cost(frontier, resolution_m) for frontier in frontiers]
        markers: list[dict[str, Any]] = []
        for frontier, cost in zip(frontiers, costs, strict=True):
            size = min(abs(costs[0] * 0.4 / cost), 0.5) if cost else 0.5
            points = [{"x": x, "y": y} for x, y in frontier.points.tolist()]
            color = _RED if self._is_refused(frontier.centroid, resolution_m) else _BLUE
            place = {"position": dict(zip("xy", frontier.initial, strict=True)), "orientation": {"w": 1.0}}
            level = {"orientation": {"w": 1.0}}
            dots = {"type": _POINTS, "scale": {"x": 0.1, "y": 0.1}, "color": color, "points": points}
            ball = {"type": _SPHERE, "scale": {"x": size, "y": size, "z": size}, "color": _GREEN, "pose": place}
            markers += [
                {**common, **dots, "pose": level, "id": len(markers)},
                {**common, **ball, "id": len(markers) + 1},
            ]
        count = len(markers)
        markers += [{**common, "action": _DELETE, "id": number} for number in range(count, self._marker_count)]
        self._marker_count = count
        self._markers.publish({"markers": markers})
