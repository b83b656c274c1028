"""yocs_waypoints_navi/yocs_waypoints_navi_node: drives along clicked points, to a goal or around."""

import math
from typing import Annotated, Any

from msgspec import Meta, Struct

from trundle.gazebo.nodes import NodeHost
from trundle.gazebo.nodes.private_parameters import private_parameters
from trundle.gazebo.nodes.rate import Rate
from trundle.robots.parameters import ParamError
from trundle.ros import SUCCEEDED, ActionClient, Node, TransformError, TransformListener
from trundle.spatial import NS_PER_S

from ..pose_messages import pose_fields, read_pose
from ..settings import read_settings

Point = tuple[float, float]
_CLOSED_M = 0.2
"""Distance from the first point within which another one closes the loop."""
_MAX_WAYPOINTS = 1000
_CYLINDER, _TEXT, _ADD, _DELETE = 3, 9, 0, 2


class WaypointsNaviSettings(Struct):
    """Lengths [m], times [s]."""

    frequency: Annotated[float, Meta(ge=0.01, le=1000.0)] = 1.0
    close_enough: Annotated[float, Meta(ge=0.0)] = 0.3
    goal_timeout: Annotated[float, Meta(ge=0.0)] = 30.0
    robot_frame: str = "/base_footprint"
    world_frame: str = "/map"


class WaypointsNavi:
    """Drives along the points of `waypoints` to the pose of `final_goal`; a point near the first one makes a loop.

    Parameters, with the original's defaults: `WaypointsNaviSettings`. A final goal on the way cancels and forgets
    everything. `waypoint_marker` shows the points. Unlike the original, the robot faces the next point.
    """

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node
        self._points: list[Point] = []
        self._goal: dict[str, Any] | None = None
        self._is_loop = False
        self._next: int | None = None
        """Index of the point under way; len(points): the final goal; None: the robot waits."""
        self._sent_ns = 0
        self._shown = 0

    async def run(self) -> int:
        """Drive until cancelled."""
        node = self._node
        try:
            self._settings = settings = read_settings(WaypointsNaviSettings, await private_parameters(node))
        except ParamError as error:
            node.log.fatal(str(error))
            return 1
        self._world, self._base = settings.world_frame.lstrip("/"), settings.robot_frame.lstrip("/")
        self._buffer = TransformListener(node).buffer
        self._client = ActionClient(node, "move_base", "move_base_msgs/MoveBase")
        kind = "visualization_msgs/MarkerArray"
        self._markers = node.advertise("waypoint_marker", kind, latch=True, queue_size=1)
        node.subscribe("waypoints", "geometry_msgs/PointStamped", self._on_point, queue_size=10, on_loop=True)
        node.subscribe("final_goal", "geometry_msgs/PoseStamped", self._on_goal, queue_size=1, on_loop=True)
        rate = Rate(node, settings.frequency)
        while not node.closed.is_set():
            if self._next is not None and self._is_due():
                self._advance()
            self._show()
            await rate.sleep()
        return 0

    def _on_point(self, message: Any) -> None:
        point = (float(message.point.x), float(message.point.y))
        if self._next is not None:
            return
        if not all(abs(value) < 1e9 for value in point) or len(self._points) >= _MAX_WAYPOINTS:
            self._node.log.error(f"a point is ignored: it is not finite, or there are {_MAX_WAYPOINTS} already")
        elif len(self._points) > 1 and math.dist(point, self._points[0]) < _CLOSED_M:
            self._node.log.info(f"Waypoints loop closed with {len(self._points)} points; lets' go!")
            self._is_loop = True
            self._send(0)
        else:
            self._points.append(point)

    def _on_goal(self, message: Any) -> None:
        if self._next is not None:
            self._node.log.info("Already have a task; cancelling...")
            self._client.cancel()
            self._reset()
            return
        try:
            pose = read_pose(message.pose)
        except ValueError as error:
            self._node.log.error(f"a goal is ignored: {error}")
            return
        self._node.log.info(f"Goal received with {len(self._points)} waypoints; lets' go!")
        self._goal = {
            "header": {"frame_id": message.header.frame_id.lstrip("/") or self._world},
            "pose": pose_fields(pose),
        }
        self._send(0)

    def _is_due(self) -> bool:
        """True if the robot is near its point, or takes too long; not on the way to the final goal."""
        assert self._next is not None
        if self._next >= len(self._points):
            return False
        late_s = (self._node.clock.now_ns() - self._sent_ns) / NS_PER_S
        if late_s >= self._settings.goal_timeout:
            self._node.log.warn(f"Cannot reach goal after {self._settings.goal_timeout:.2f} seconds; request a new one")
            return True
        try:
            robot = self._buffer.lookup_transform(self._world, self._base).pose.position
        except TransformError as error:
            self._node.log.warn(f"Cannot get tf {self._world} -> {self._base}: {error}")
            return False
        return math.dist(robot[:2], self._points[self._next]) <= self._settings.close_enough

    def _advance(self) -> None:
        assert self._next is not None
        following = self._next + 1
        self._send(following % len(self._points) if self._is_loop else following)

    def _send(self, index: int) -> None:
        self._next, self._sent_ns = index, self._node.clock.now_ns()
        if index >= len(self._points):
            assert self._goal is not None
            target = self._goal
        else:
            x, y = self._points[index]
            after = self._points[(index + 1) % len(self._points)]
            if index + 1 == len(self._points) and self._goal is not None:
                after = (self._goal["pose"]["position"]["x"], self._goal["pose"]["position"]["y"])
            yaw = math.atan2(after[1] - y, after[0] - x)
            rotation = {"z": math.sin(yaw / 2.0), "w": math.cos(yaw / 2.0)}
            target = {
                "header": {"frame_id": self._world},
                "pose": {"position": {"x": x, "y": y}, "orientation": rotation},
            }
        stamped = {**target, "header": {**target["header"], "stamp": self._sent_ns}}
        call = self._node.loop.call_soon
        self._client.send({"target_pose": stamped}, lambda state: call(lambda: self._end(index, state)))

    def _end(self, index: int, state: int) -> None:
        """Send the next point, whether this one was reached or not, as the original."""
        if self._next != index:
            return
        if index < len(self._points):
            self._advance()
            return
        if state == SUCCEEDED:
            self._node.log.info("Go to goal successfully completed")
        else:
            self._node.log.error(f"Go to goal failed: state {state}")
        self._reset()

    def _reset(self) -> None:
        self._points, self._goal, self._is_loop, self._next = [], None, False, None

    def _show(self) -> None:
        if not (self._points or self._shown) or not self._markers.has_subscribers:
            return
        markers: list[dict[str, Any]] = []
        header = {"stamp": self._node.clock.now_ns(), "frame_id": self._world}
        for number, (x, y) in enumerate(self._points):
            color = {"r": 0.8, "g": 0.2, "b": 0.2, "a": 1.0 if number == self._next else 0.6}
            common = {"header": header, "ns": f"WP {number}", "color": color, "action": _ADD}
            place = {"position": {"x": x, "y": y, "z": 0.005}, "orientation": {"w": 1.0}}
            above = {"position": {"x": x, "y": y, "z": 0.06}, "orientation": {"w": 1.0}}
            size = {"x": 0.08, "y": 0.08, "z": 0.01}
            markers.append({**common, "id": number, "type": _CYLINDER, "scale": size, "pose": place})
            text = {"type": _TEXT, "scale": {"z": 0.1}, "text": str(number), "pose": above}
            markers.append({**common, "id": number + 1_000_000, **text})
        for number in range(len(self._points), self._shown):
            gone = {"header": header, "ns": f"WP {number}", "action": _DELETE}
            markers += [{**gone, "id": number}, {**gone, "id": number + 1_000_000}]
        self._shown = len(self._points)
        self._markers.publish({"markers": markers})
