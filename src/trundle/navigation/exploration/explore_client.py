"""frontier_exploration/explore_client: sends a boundary that a person clicks."""

import math
from typing import Any

import numpy as np

from trundle.gazebo.nodes import NodeHost
from trundle.ros import ActionClient, Node

from ..pose_messages import is_place
from .frontier import Point, is_inside

_PERIOD_S = 0.1
_CLOSE_RATIO = 0.1
"""Distance from the first corner within which a click closes the polygon, per mean length of the polygon's edges."""
_LINE_STRIP, _SPHERE_LIST, _DELETE = 4, 7, 2
_MAX_CORNERS = 1000


class ExploreClient:
    """Makes a polygon of clicks on `/clicked_point`, and sends it to the action `explore_server`.

    A click near the first one closes the polygon; the click after it sets where the exploration begins.
    `exploration_polygon_marker` shows the polygon.
    """

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node
        self._corners: list[Point] = []
        self._frame = "map"
        self._is_closed = False

    async def run(self) -> int:
        """Run until cancelled."""
        node = self._node
        self._markers = node.advertise("exploration_polygon_marker", "visualization_msgs/Marker", queue_size=10)
        self._client = ActionClient(node, "explore_server", "frontier_exploration/ExploreTask")
        node.subscribe("/clicked_point", "geometry_msgs/PointStamped", self._on_click, queue_size=10)
        node.log.info("Please use the 'Point' tool in Rviz to select an exporation boundary.")
        while not node.closed.is_set():
            self._show()
            await node.clock.sleep(_PERIOD_S)
        return 0

    def _on_click(self, message: Any) -> None:
        log, frame = self._node.log, message.header.frame_id
        point = (float(message.point.x), float(message.point.y))
        if not is_place(point) or len(self._corners) >= _MAX_CORNERS:
            log.error(
                f"a point is ignored: it is not finite or beyond 1e9 m, or the polygon has {_MAX_CORNERS} corners"
            )
        elif self._is_closed:
            self._send(point, frame)
        elif not self._corners:
            self._frame, self._corners = frame, [point]
        elif frame != self._frame:
            log.error("Frame mismatch, restarting polygon selection")
            self._corners = []
        elif len(self._corners) > 1 and math.dist(point, self._corners[0]) < _CLOSE_RATIO * self._mean_edge():
            self._close()
        else:
            self._corners.append(point)

    def _mean_edge(self) -> float:
        ends = [*self._corners[1:], self._corners[0]]
        return sum(math.dist(a, b) for a, b in zip(self._corners, ends, strict=True)) / len(self._corners)

    def _close(self) -> None:
        if len(self._corners) < 3:
            self._node.log.error("Not a valid polygon, restarting")
            self._corners = []
            return
        self._is_closed = True
        self._node.log.warn("Please select an initial point for exploration inside the polygon")

    def _send(self, center: Point, frame: str) -> None:
        if not is_inside(np.array(self._corners), *center):
            self._node.log.error("Center not inside polygon, restarting")
        elif not self._client.has_server:
            self._node.log.error("there is no explore_server; start it, and select the polygon again")
        else:
            self._node.log.info("Sending goal")
            stamp_ns = self._node.clock.now_ns()
            points = [{"x": x, "y": y} for x, y in self._corners]
            boundary = {"header": {"stamp": stamp_ns, "frame_id": self._frame}, "polygon": {"points": points}}
            place = {"header": {"stamp": stamp_ns, "frame_id": frame}, "point": {"x": center[0], "y": center[1]}}
            self._client.send({"explore_boundary": boundary, "explore_center": place}, lambda _: None)
        self._corners, self._is_closed = [], False

    def _show(self) -> None:
        points: list[dict[str, Any]] = [{"x": x, "y": y} for x, y in self._corners]
        line = [*points, points[0]] if self._is_closed else points
        color = {"r": 1.0, "a": 1.0} if self._is_closed else {"b": 1.0, "a": 1.0}
        for number, (kind, places, width) in enumerate([(_SPHERE_LIST, points, 0.1), (_LINE_STRIP, line, 0.05)]):
            self._markers.publish(
                {
                    "header": {"stamp": self._node.clock.now_ns(), "frame_id": self._frame},
                    "ns": "explore_points",
                    "id": number,
                    "type": kind,
                    "action": 0 if points else _DELETE,
                    "pose": {"orientation": {"w": 1.0}},
                    "scale": {"x": width, "y": width, "z": width},
                    "color": color,
                    "points": places,
                }
            )
