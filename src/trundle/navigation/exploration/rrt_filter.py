"""rrt_exploration/filter.py: makes few points of many."""

from typing import Annotated, Any

import numpy as np
from msgspec import Meta, Struct
from numpy.typing import NDArray

from trundle.gazebo.nodes import NodeHost
from trundle.gazebo.nodes.private_parameters import private_parameters
from trundle.gazebo.nodes.rate import LogThrottle, Rate
from trundle.robots.parameters import ParamError
from trundle.ros import Node, TransformError, TransformListener

from ..pose_messages import is_place
from ..settings import read_settings
from .frontier import Point
from .map_listener import MapListener

_BANDWIDTH_M = 0.3
_LEAST_GAIN_M2 = 0.2
_MAX_POINTS = 500
_MAX_SHIFTS = 300
_POINTS = 8


class RrtFilterSettings(Struct):
    """info_radius: [m]; costmap_clearing_threshold: occupancy of a point above which it is dropped."""

    map_topic: str = "/map"
    costmap_clearing_threshold: float = 70.0
    info_radius: Annotated[float, Meta(ge=0.0, le=1000.0)] = 1.0
    goals_topic: str = "/detected_points"
    n_robots: Annotated[int, Meta(ge=1, le=100)] = 1
    namespace: str = ""
    rate: Annotated[float, Meta(ge=0.001, le=1000.0)] = 100.0
    global_costmap_topic: str = "/move_base_node/global_costmap/costmap"
    robot_frame: str = "base_link"


def robot_names(namespace: str, count: int, first: int) -> list[str]:
    """Return the prefix of each robot's names: empty for a single robot without a namespace."""
    return [f"{namespace}{number}" for number in range(first, first + count)] if namespace else [""]


def mean_shift(points: NDArray[np.float64], bandwidth: float) -> NDArray[np.float64]:
    """Return the centers (k, 2) of clusters of points (n, 2), by mean shift with a flat kernel; the fullest first.

    Comaniciu and Meer, Mean shift: a robust approach toward feature space analysis, PAMI 2002.
    """
    means = points.copy()
    for _ in range(_MAX_SHIFTS):
        is_near = ((means[:, None] - points) ** 2).sum(axis=2) <= bandwidth**2
        shifted = is_near @ points / is_near.sum(axis=1, keepdims=True)
        is_settled = bool(np.abs(shifted - means).max() < 1e-3 * bandwidth)
        means = shifted
        if is_settled:
            break
    counts = (((means[:, None] - points) ** 2).sum(axis=2) <= bandwidth**2).sum(axis=1)
    centers = np.empty((0, 2))
    for mean in means[np.lexsort((means[:, 1], means[:, 0], -counts))]:
        if not np.any(((centers - mean) ** 2).sum(axis=1) <= bandwidth**2):
            centers = np.vstack([centers, mean])
    return centers


class RrtFilter:
    """Clusters detected points, and drops those in obstacles and those with little unknown space around.

    Parameters, with the original's names and defaults: `RrtFilterSettings`, and namespace_init_count 1 beside the
    node. The points are published on `filtered_points`, and as markers on `frontiers` and `centroids`.
    """

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node
        self._points = np.empty((0, 2))

    async def run(self) -> int:
        """Filter until cancelled."""
        node = self._node
        try:
            settings = self._settings = read_settings(RrtFilterSettings, await private_parameters(node))
            first = int(await node.params.get("namespace_init_count", 1))
        except (ParamError, TypeError, ValueError) as error:
            node.log.fatal(str(error))
            return 1
        self._buffer = TransformListener(node).buffer
        self._warnings = LogThrottle(node, 5.0)
        self._map = MapListener(node, settings.map_topic)
        names = robot_names(settings.namespace, settings.n_robots, first)
        self._costmaps = [MapListener(node, f"{name}{settings.global_costmap_topic}") for name in names]
        node.subscribe(settings.goals_topic, "geometry_msgs/PointStamped", self._on_point, queue_size=100)
        marker = "visualization_msgs/Marker"
        self._frontiers = node.advertise("frontiers", marker, queue_size=10)
        self._centroids = node.advertise("centroids", marker, queue_size=10)
        filtered = node.advertise("filtered_points", "rrt_exploration/PointArray", queue_size=10)
        rate = Rate(node, settings.rate)
        while not node.closed.is_set():
            if missing := self._missing():
                self._warnings.warn(f"waiting for {missing}")
            elif len(self._points):
                found = self._points = mean_shift(self._points, _BANDWIDTH_M)
                kept = [(x, y) for x, y in found.tolist() if self._is_worthwhile((x, y))]
                filtered.publish({"points": [{"x": x, "y": y} for x, y in kept]})
                self._show(self._frontiers, "markers2", 0, found.tolist(), {"r": 1.0, "g": 1.0, "a": 1.0})
                self._show(self._centroids, "markers3", 4, kept, {"g": 1.0, "a": 1.0})
            await rate.sleep()
        return 0

    def _missing(self) -> str:
        if not self._map.cells.size:
            return f"a map on {self._settings.map_topic}"
        if not all(costmap.cells.size for costmap in self._costmaps):
            return f"global costmaps on {self._settings.global_costmap_topic}"
        return ""

    def _on_point(self, message: Any) -> None:
        point = (float(message.point.x), float(message.point.y))
        moved = self._moved(point, message.header.frame_id.lstrip("/"), self._map.frame)
        if moved is not None and is_place(moved) and len(self._points) < _MAX_POINTS:
            self._points = np.vstack([self._points, moved])

    def _moved(self, point: Point, frame: str, to: str) -> Point | None:
        """Return a point in another frame, or None if there is no transform."""
        if frame == to or not frame:
            return point
        try:
            x, y, _ = self._buffer.lookup_transform(to, frame).pose.transform_point((*point, 0.0))
        except TransformError as error:
            self._warnings.warn(f"a point is ignored: {error}")
            return None
        return x, y

    def _is_worthwhile(self, point: Point) -> bool:
        for costmap in self._costmaps:
            moved = self._moved(point, self._map.frame, costmap.frame)
            if moved is None or costmap.values(np.array([moved]))[0] > self._settings.costmap_clearing_threshold:
                return False
        return self._map.information_gain(point, 0.5 * self._settings.info_radius) >= _LEAST_GAIN_M2

    def _show(self, publisher: Any, namespace: str, number: int, places: Any, color: dict[str, float]) -> None:
        if publisher.has_subscribers:
            publisher.publish(
                {
                    "header": {"frame_id": self._map.frame},
                    "ns": namespace,
                    "id": number,
                    "type": _POINTS,
                    "pose": {"orientation": {"w": 1.0}},
                    "scale": {"x": 0.2, "y": 0.2},
                    "color": color,
                    "points": [{"x": x, "y": y} for x, y in places],
                }
            )
