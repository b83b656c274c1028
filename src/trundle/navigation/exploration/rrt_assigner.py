"""rrt_exploration/assigner.py: sends robots to filtered points."""

import math
from typing import Annotated, Any

import numpy as np
from msgspec import Meta, Struct

from trundle.gazebo.nodes import NodeHost
from trundle.gazebo.nodes.private_parameters import private_parameters
from trundle.gazebo.nodes.rate import LogThrottle, Rate
from trundle.robots.parameters import ParamError
from trundle.ros import ABORTED, SUCCEEDED, ActionClient, Node, TransformError, TransformListener
from trundle.spatial import NS_PER_S

from ..pose_messages import is_place
from ..settings import read_settings
from .frontier import Point
from .map_listener import MapListener
from .rrt_filter import robot_names

_SAME_M = 0.2
"""Distance below which a robot keeps its goal: clusters move a little with each point [m]."""
_DONE_M = 0.3
"""Distance from a goal that has ended, within which points are left out [m]."""
_PATIENCE_NS = 10 * NS_PER_S
"""Time without progress after which a goal is given up."""


class RrtAssignerSettings(Struct):
    """Radii [m], delay_after_assignement [s]."""

    map_topic: str = "/map"
    info_radius: Annotated[float, Meta(ge=0.0, le=1000.0)] = 1.0
    info_multiplier: float = 3.0
    hysteresis_radius: float = 3.0
    hysteresis_gain: float = 2.0
    frontiers_topic: str = "/filtered_points"
    n_robots: Annotated[int, Meta(ge=1, le=100)] = 1
    namespace: str = ""
    delay_after_assignement: Annotated[float, Meta(ge=0.0, le=1e6)] = 0.5
    rate: Annotated[float, Meta(ge=0.001, le=1000.0)] = 100.0
    global_frame: str = "/map"
    robot_frame: str = "base_link"


class _Robot:
    def __init__(self, node: Node, name: str) -> None:
        self.name = name
        self.client = ActionClient(node, f"{name}/move_base", "move_base_msgs/MoveBase")
        self.place: Point = (0.0, 0.0)
        self.assigned: Point | None = None
        self.is_busy = False
        self.unknown_m2 = 0.0
        """Unknown area around the goal when it was sent [m²]."""
        self.done: list[Point] = []
        """Goals that ended: what is unknown there is seen from elsewhere, or never."""
        self._nearest_m = math.inf
        self._progress_ns = 0

    def send(self, point: Point, frame: str, stamp_ns: int) -> None:
        self.assigned, self.is_busy = point, True
        self._nearest_m, self._progress_ns = math.inf, stamp_ns
        pose = {"position": {"x": point[0], "y": point[1]}, "orientation": {"w": 1.0}}
        goal = {"target_pose": {"header": {"frame_id": frame, "stamp": stamp_ns}, "pose": pose}}
        self.client.send(goal, lambda state: self._end(point, state))

    def _end(self, point: Point, state: int) -> None:
        if point == self.assigned:
            self.is_busy = False
        if state in (SUCCEEDED, ABORTED):
            self.done.append(point)

    def move(self, place: Point, now_ns: int) -> None:
        """Store the robot's place; give its goal up if it came no nearer."""
        self.place = place
        if not self.is_busy or self.assigned is None:
            return
        distance_m = math.dist(place, self.assigned)
        if distance_m < self._nearest_m - _SAME_M:
            self._nearest_m, self._progress_ns = distance_m, now_ns
        elif now_ns - self._progress_ns > _PATIENCE_NS:
            self.is_busy = False
            self.done.append(self.assigned)

    def has_done(self, point: Point) -> bool:
        return any(math.dist(point, other) < _DONE_M for other in self.done)


class RrtAssigner:
    """Sends each robot, by its `move_base`, to the point with the highest revenue.

    Revenue: info_multiplier times the unknown area within info_radius [m²], times hysteresis_gain if the point is
    within hysteresis_radius, minus the distance [m]. Unknown cells near other goals do not count. A free robot gets
    a point before one that drives; if all drive, one gets another as soon as half of what was unknown around its goal
    is known. A goal that is hardly another is not sent.
    Goals that were reached or aborted, or to which a robot came no nearer for 10 s, are left out from then on.
    Parameters, with the original's names and defaults: `RrtAssignerSettings`, and namespace_init_count 1 beside the
    node.
    """

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node
        self._points: list[Point] = []

    async def run(self) -> int:
        """Assign until cancelled."""
        node = self._node
        try:
            settings = self._settings = read_settings(RrtAssignerSettings, await private_parameters(node))
            first = int(await node.params.get("namespace_init_count", 1))
        except (ParamError, TypeError, ValueError) as error:
            node.log.fatal(str(error))
            return 1
        self._frame = settings.global_frame.lstrip("/")
        self._buffer = TransformListener(node).buffer
        self._map = MapListener(node, settings.map_topic)
        names = robot_names(settings.namespace, settings.n_robots, first)
        self._robots = [_Robot(node, name) for name in names]
        node.subscribe(settings.frontiers_topic, "rrt_exploration/PointArray", self._on_points, queue_size=1)
        warnings, rate = LogThrottle(node, 5.0), Rate(node, settings.rate)
        while not node.closed.is_set():
            if missing := self._missing():
                warnings.warn(f"waiting for {missing}")
            elif self._assign():
                await node.clock.sleep(settings.delay_after_assignement)
            await rate.sleep()
        return 0

    def _on_points(self, message: Any) -> None:
        points = [(float(point.x), float(point.y)) for point in message.points]
        self._points = [point for point in points if is_place(point)]

    def _missing(self) -> str:
        """Return what there is none of yet; else update the robots' places."""
        if not self._map.cells.size:
            return f"a map on {self._settings.map_topic}"
        for robot in self._robots:
            base = f"{robot.name}/{self._settings.robot_frame.lstrip('/')}".lstrip("/")
            try:
                x, y, _ = self._buffer.lookup_transform(self._frame, base).pose.position
            except TransformError:
                return f"the transform from {base} to {self._frame}"
            if not robot.client.has_server:
                return f"{robot.name}/move_base"
            robot.move((x, y), self._node.clock.now_ns())
        return ""

    def _assign(self) -> bool:
        """Send the robot and point with the highest revenue; False: no goal was sent."""
        settings = self._settings
        free = [robot for robot in self._robots if not robot.is_busy]
        movable = free or [robot for robot in self._robots if self._is_seen(robot)]
        best: tuple[float, _Robot, Point] | None = None
        for robot in movable:
            others = [other.assigned for other in self._robots if other is not robot and other.assigned is not None]
            for point in self._points:
                if robot.has_done(point):
                    continue
                gain = self._gain(point, others)
                is_near = math.dist(robot.place, point) <= settings.hysteresis_radius
                is_kept = not free and robot.assigned is not None
                is_kept = is_kept and math.dist(robot.assigned or point, point) < settings.hysteresis_radius
                if is_near or is_kept:
                    gain *= settings.hysteresis_gain
                revenue = gain * settings.info_multiplier - math.dist(robot.place, point)
                if best is None or revenue > best[0]:
                    best = (revenue, robot, point)
        if best is None:
            return False
        _, robot, point = best
        if robot.is_busy and robot.assigned is not None and math.dist(robot.assigned, point) < _SAME_M:
            return False
        robot.send(point, self._frame, self._node.clock.now_ns())
        robot.unknown_m2 = self._gain(point, [])
        self._node.log.info(f"{robot.name or 'the robot'} assigned to {point[0]:.2f}, {point[1]:.2f}")
        return True

    def _is_seen(self, robot: _Robot) -> bool:
        """True if half of what was unknown around the robot's goal is known."""
        return robot.assigned is None or self._gain(robot.assigned, []) <= 0.5 * robot.unknown_m2

    def _gain(self, point: Point, others: list[Point]) -> float:
        """Return the unknown area [m²] around a point, without that around the goals of others."""
        radius = self._settings.info_radius
        unknown = self._map.unknown_near(point, radius)
        for other in others:
            unknown = unknown[np.hypot(unknown[:, 0] - other[0], unknown[:, 1] - other[1]) > radius]
        return len(unknown) * self._map.resolution_m**2
