"""follow_waypoints/follow_waypoints: drives to poses that a person set, in their order."""

import asyncio
import math
from typing import Any

from trundle.gazebo.nodes import NodeHost
from trundle.gazebo.nodes.private_parameters import private_parameters
from trundle.robots.parameters import ParamError
from trundle.ros import ActionClient, Node, TransformError, TransformListener

from ..pose_messages import pose_fields, read_pose

_POLL_S = 0.1
_MAX_WAYPOINTS = 1000


class FollowWaypoints:
    """Collects poses from `initialpose`, and sends them to `move_base` after `path_ready`.

    `path_reset` empties the queue; `waypoints` shows it. Parameters, with the original's defaults: goal_frame_id map,
    wait_duration 0 [s], robot_frame base_link, distance_tolerance 0 [m]: from there on the next waypoint is sent,
    without the last approach.
    """

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node
        self._poses: list[dict[str, Any]] = []
        self._is_ready = asyncio.Event()
        self._is_reset = False

    async def run(self) -> int:
        """Follow until cancelled."""
        node = self._node
        try:
            parameters = await private_parameters(node)
            self._frame = parameters.text("goal_frame_id", "map").lstrip("/")
            self._pause_s = parameters.number("wait_duration", 0.0, minimum=0.0)
            self._base = parameters.text("robot_frame", parameters.text("base_frame_id", "base_link")).lstrip("/")
            self._tolerance_m = parameters.number("distance_tolerance", 0.0, minimum=0.0)
        except ParamError as error:
            node.log.fatal(str(error))
            return 1
        self._buffer = TransformListener(node).buffer
        self._client = ActionClient(node, "move_base", "move_base_msgs/MoveBase")
        self._queue = node.advertise("waypoints", "geometry_msgs/PoseArray", latch=True, queue_size=1)
        kind = "geometry_msgs/PoseWithCovarianceStamped"
        node.subscribe("initialpose", kind, self._on_pose, queue_size=10, on_loop=True)
        node.subscribe("path_ready", "std_msgs/Empty", self._on_ready, queue_size=1, on_loop=True)
        node.subscribe("path_reset", "std_msgs/Empty", self._on_reset, queue_size=1, on_loop=True)
        node.log.info("Waiting to receive waypoints via Pose msg on topic initialpose")
        node.log.info("To start following waypoints: 'rostopic pub /path_ready std_msgs/Empty -1'")
        while not node.closed.is_set():
            self._show()
            await self._is_ready.wait()
            self._is_reset = False
            await self._follow()
            self._is_ready.clear()
            self._poses.clear()
        return 0

    def _on_pose(self, message: Any) -> None:
        try:
            pose = read_pose(message.pose.pose)
            frame = message.header.frame_id.lstrip("/") or self._frame
            if frame != self._frame:
                pose = self._buffer.lookup_transform(self._frame, frame).pose @ pose
        except (ValueError, TransformError) as error:
            self._node.log.error(f"a waypoint is ignored: {error}")
            return
        if self._is_ready.is_set() or len(self._poses) >= _MAX_WAYPOINTS:
            self._node.log.warn(f"a waypoint is ignored: the path is followed now, or has {_MAX_WAYPOINTS} already")
            return
        self._poses.append(pose_fields(pose))
        self._node.log.info("Received new waypoint")
        self._show()

    def _on_ready(self, _message: Any) -> None:
        self._node.log.info("Received path READY message")
        self._is_ready.set()

    def _on_reset(self, _message: Any) -> None:
        self._node.log.info("Received path RESET message")
        self._is_reset = True
        self._poses.clear()
        self._client.cancel()
        self._show()

    def _show(self) -> None:
        header = {"stamp": self._node.clock.now_ns(), "frame_id": self._frame}
        self._queue.publish({"header": header, "poses": self._poses})

    async def _follow(self) -> None:
        node = self._node
        while not self._client.has_server:
            node.log.info("Connecting to move_base...")
            await node.clock.sleep(1.0)
        for pose in list(self._poses):
            x, y = pose["position"]["x"], pose["position"]["y"]
            node.log.info(f"Executing move_base goal to position (x,y): {x}, {y}")
            ended = asyncio.Event()
            header = {"stamp": node.clock.now_ns(), "frame_id": self._frame}
            goal = {"target_pose": {"header": header, "pose": pose}}
            self._client.send(goal, lambda _, ended=ended: node.loop.call_soon(ended.set))
            while not (ended.is_set() or self._is_reset or self._is_near(x, y)):
                await node.clock.sleep(_POLL_S)
            if self._is_reset:
                node.log.info("The waypoint queue has been reset.")
                return
            await node.clock.sleep(self._pause_s)
        node.log.info("REACHED FINISH GATE")

    def _is_near(self, x: float, y: float) -> bool:
        if self._tolerance_m <= 0.0:
            return False
        try:
            robot = self._buffer.lookup_transform(self._frame, self._base).pose.position
        except TransformError:
            return False
        return math.hypot(robot[0] - x, robot[1] - y) <= self._tolerance_m
