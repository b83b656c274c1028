"""rrt_exploration's detectors: trees that grow at random until a branch reaches unknown space.

The method: Umari and Mukhopadhyay, Autonomous robotic exploration based on multiple rapidly-exploring randomized trees,
IROS 2017.
"""

import math
from typing import Annotated, Any, ClassVar

import numpy as np
from msgspec import Meta, Struct
from numpy.typing import NDArray

from trundle.gazebo.nodes import NodeHost
from trundle.gazebo.nodes.private_parameters import private_parameters
from trundle.gazebo.nodes.rate import Rate
from trundle.robots.parameters import ParamError
from trundle.ros import Node, TransformError, TransformListener
from trundle.spatial import NS_PER_S

from ..pose_messages import is_place
from ..settings import read_settings
from .frontier import Point
from .map_listener import OCCUPIED, UNKNOWN, MapListener

_RATE_HZ = 100.0
_STEP_RATIO = 0.2
"""Step along a branch, per size of a cell, as in the original."""
_MAX_STEPS = 100_000
_MAX_VERTICES = 20_000
"""Largest number of branches, after which the tree starts again: one in each 0.1 m × 0.1 m of 200 m²."""
_CLICKS = 5
_SHOWN_NS = NS_PER_S // 2
_LINE_LIST, _POINTS = 5, 8
_SEED = 0x123


class RrtDetectorSettings(Struct):
    """eta: length of a branch [m]."""

    eta: Annotated[float, Meta(ge=0.001, le=1e6)] = 0.5
    map_topic: str = "/robot_1/map"
    robot_frame: str = "/robot_1/base_link"


class _RrtDetector:
    _color: ClassVar[dict[str, float]]
    _follows_robot: ClassVar[bool]

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node
        self._clicks: list[Point] = []

    async def run(self) -> int:
        """Grow the tree until cancelled."""
        node = self._node
        try:
            self._settings = read_settings(RrtDetectorSettings, await private_parameters(node))
        except ParamError as error:
            node.log.fatal(str(error))
            return 1
        self._buffer = TransformListener(node).buffer
        self._map = MapListener(node, self._settings.map_topic)
        node.subscribe("/clicked_point", "geometry_msgs/PointStamped", self._on_click, queue_size=100)
        self._points = node.advertise("/detected_points", "geometry_msgs/PointStamped", queue_size=10)
        self._shapes = node.advertise(f"{node.name}_shapes", "visualization_msgs/Marker", queue_size=10)
        rate = Rate(node, _RATE_HZ)
        while len(self._clicks) < _CLICKS or not self._map.cells.size:
            if node.closed.is_set():
                return 0
            await rate.sleep()
        (x0, y0), _, (x1, y1), _, root = self._clicks
        random = np.random.default_rng(_SEED)
        self._plant(root)
        shown_ns = 0
        while not node.closed.is_set():
            self._grow((random.uniform(min(x0, x1), max(x0, x1)), random.uniform(min(y0, y1), max(y0, y1))))
            now_ns = node.clock.now_ns()
            if abs(now_ns - shown_ns) >= _SHOWN_NS and self._shapes.has_subscribers:
                shown_ns = now_ns
                self._show_tree()
            await rate.sleep()
        return 0

    def _on_click(self, message: Any) -> None:
        point = (float(message.point.x), float(message.point.y))
        if len(self._clicks) >= _CLICKS:
            return
        if not is_place(point):
            self._node.log.error("a clicked point is ignored: it is not finite or beyond 1e9 m")
            return
        self._clicks.append(point)
        self._show([{"x": x, "y": y} for x, y in self._clicks])

    def _plant(self, root: Point) -> None:
        self._vertices = np.empty((_MAX_VERTICES, 2))
        self._parents = np.zeros(_MAX_VERTICES, dtype=np.intp)
        self._vertices[0] = root
        self._count = 1

    def _grow(self, sample: Point) -> None:
        """Grow the nearest branch toward a point, as far as the map is free."""
        tree = self._vertices[: self._count]
        nearest = int(((tree - sample) ** 2).sum(axis=1).argmin())
        start = tree[nearest].copy()
        length = math.dist(start, sample)
        if length == 0.0:
            return
        way = (np.array(sample) - start) * min(1.0, self._settings.eta / length)
        count = math.ceil(float(np.hypot(*way)) / (self._map.resolution_m * _STEP_RATIO))
        points = start + np.linspace(0.0, 1.0, min(count, _MAX_STEPS) + 1)[1:, None] * way
        values = self._map.values(points)
        ends = np.flatnonzero((values == UNKNOWN) | (values == OCCUPIED))
        if not len(ends):
            self._add(nearest, points[-1])
        elif values[ends[0]] == UNKNOWN:
            self._report(points[ends[0]])

    def _add(self, parent: int, vertex: NDArray[np.float64]) -> None:
        if self._count == _MAX_VERTICES:
            self._plant((float(self._vertices[0, 0]), float(self._vertices[0, 1])))
            parent = 0
        self._vertices[self._count], self._parents[self._count] = vertex, parent
        self._count += 1

    def _report(self, point: NDArray[np.float64]) -> None:
        fields = {"x": float(point[0]), "y": float(point[1])}
        self._points.publish({"header": {"frame_id": self._map.frame}, "point": fields})
        self._show([fields])
        if self._follows_robot:
            try:
                frame = self._settings.robot_frame.lstrip("/")
                x, y, _ = self._buffer.lookup_transform(self._map.frame, frame).pose.position
            except TransformError:
                return
            self._plant((x, y))

    def _show(self, points: list[dict[str, float]]) -> None:
        color = {"r": 1.0, "a": 1.0}
        self._publish({"id": 0, "type": _POINTS, "scale": {"x": 0.3, "y": 0.3}, "color": color, "points": points})

    def _show_tree(self) -> None:
        ends = self._vertices[1 : self._count]
        starts = self._vertices[self._parents[1 : self._count]]
        lines = np.stack([ends, starts], axis=1).reshape(-1, 2)
        points = [{"x": x, "y": y} for x, y in lines.tolist()]
        scale = {"x": 0.03, "y": 0.03}
        self._publish({"id": 1, "type": _LINE_LIST, "scale": scale, "color": self._color, "points": points})

    def _publish(self, marker: dict[str, Any]) -> None:
        common = {"header": {"frame_id": self._map.frame}, "ns": "markers", "pose": {"orientation": {"w": 1.0}}}
        self._shapes.publish({**common, **marker})


class GlobalRrtDetector(_RrtDetector):
    """Publishes points at the edge of known space on `/detected_points`; its tree keeps growing over the whole map.

    Five points on `/clicked_point` start it: the corners of the region to explore, in order, and the tree's root.
    Parameters, with the original's names and defaults: eta 0.5, map_topic /robot_1/map. `NAME_shapes` shows the tree.
    """

    _color: ClassVar[dict[str, float]] = {"r": 0.035, "g": 0.357, "b": 0.925, "a": 1.0}
    _follows_robot = False


class LocalRrtDetector(_RrtDetector):
    """`local_rrt_detector`: after each frontier point its tree starts again at the robot (`~robot_frame`)."""

    _color: ClassVar[dict[str, float]] = {"r": 1.0, "a": 1.0}
    _follows_robot = True
