"""What cartographer_node shows of its graph: submaps, trajectories, states."""

import asyncio
from collections.abc import Coroutine
from pathlib import Path
from typing import Any

from trundle.base.diagnostics import UsageError
from trundle.gazebo.nodes.rate import Rate
from trundle.ros import Node

from ..pose_messages import from_planar, pose_fields
from . import _mapping
from .cartographer_settings import CartographerSettings
from .graph_file import write_graph
from .graph_map import GraphMap, graph_markers
from .submap_textures import pack_texture

_OK, _INVALID, _NOT_FOUND = 0, 3, 5
_ACTIVE, _FINISHED = 0, 1
_LEAST_MARKER_PERIOD_S = 0.5
_PACKAGE = "cartographer_ros_msgs"


class CartographerServices:
    """Topics and services of the one trajectory, number 0, and its one submap."""

    def __init__(
        self, node: Node, slam: _mapping.GraphSlam, access: asyncio.Lock, settings: CartographerSettings
    ) -> None:
        """Advertise.

        Args:
            node: node that advertises.
            slam: the graph.
            access: held while the graph is changed or read.
            settings: frames and periods.
        """
        self._node = node
        self._slam = slam
        self._access = access
        self._settings = settings
        self._map = GraphMap(slam, frame=settings.map_frame, resolution=settings.resolution)
        self._version = 0
        self.is_finished = False
        """True: scans are left out from now on."""
        self._submaps = node.advertise("submap_list", f"{_PACKAGE}/SubmapList", queue_size=1)
        self._nodes = node.advertise("trajectory_node_list", "visualization_msgs/MarkerArray", queue_size=1)
        node.advertise_service("submap_query", f"{_PACKAGE}/SubmapQuery", self._on_submap)
        node.advertise_service("trajectory_query", f"{_PACKAGE}/TrajectoryQuery", self._on_trajectory)
        node.advertise_service("finish_trajectory", f"{_PACKAGE}/FinishTrajectory", self._on_finish)
        node.advertise_service("get_trajectory_states", f"{_PACKAGE}/GetTrajectoryStates", self._on_states)
        node.advertise_service("write_state", f"{_PACKAGE}/WriteState", self._on_write)

    def count(self) -> None:
        """Note that a scan was added."""
        self._version += 1

    def jobs(self) -> list[Coroutine[Any, Any, None]]:
        """Return what runs until the node ends."""
        return [self._publish_submaps(), self._publish_nodes()]

    async def _publish_submaps(self) -> None:
        rate = Rate(self._node, 1.0 / self._settings.submap_publish_period_sec)
        while True:
            await rate.sleep()
            entry = {"submap_version": self._version, "pose": pose_fields(from_planar(0.0, 0.0, 0.0))}
            header = {"stamp": self._node.clock.now_ns(), "frame_id": self._settings.map_frame}
            self._submaps.publish({"header": header, "submap": [entry] if self._version else []})

    async def _publish_nodes(self) -> None:
        rate = Rate(self._node, 1.0 / max(self._settings.trajectory_publish_period_sec, _LEAST_MARKER_PERIOD_S))
        while True:
            await rate.sleep()
            if not self._nodes.has_subscribers:
                continue
            async with self._access:
                stamp_ns = self._node.clock.now_ns()
                message = graph_markers(self._slam, frame=self._settings.map_frame, stamp_ns=stamp_ns)
            self._nodes.publish(message)

    # -- services

    def _status(self, code: int, message: str) -> dict[str, Any]:
        return {"status": {"code": code, "message": message}}

    def _fault(self, trajectory_id: int) -> dict[str, Any] | None:
        """Return the answer to a request for another trajectory."""
        return None if trajectory_id == 0 else self._status(_NOT_FOUND, f"no trajectory {trajectory_id}; there is 0")

    async def _on_submap(self, request: Any) -> dict[str, Any]:
        if fault := self._fault(request.trajectory_id):
            return fault
        version = self._version
        with self._node.loop.work.pending("the map"):
            async with self._access:
                is_drawn = await self._map.draw(self._node.clock.now_ns())
            if request.submap_index != 0 or not is_drawn or self._map.message is None:
                return self._status(_NOT_FOUND, f"no submap {request.submap_index}")
            texture = await asyncio.to_thread(pack_texture, self._map.message)
        return {**self._status(_OK, "Success."), "submap_version": version, "textures": [texture]}

    async def _on_trajectory(self, request: Any) -> dict[str, Any]:
        if fault := self._fault(request.trajectory_id):
            return fault
        async with self._access:
            poses = self._slam.poses().tolist()
        header = {"frame_id": self._settings.map_frame}
        trajectory = [{"header": header, "pose": pose_fields(from_planar(*pose))} for pose in poses]
        return {**self._status(_OK, f"{len(poses)} nodes"), "trajectory": trajectory}

    def _on_finish(self, request: Any) -> dict[str, Any]:
        if fault := self._fault(request.trajectory_id):
            return fault
        if self.is_finished:
            return self._status(_INVALID, "trajectory 0 is finished already")
        self.is_finished = True
        return self._status(_OK, "trajectory 0 is finished")

    def _on_states(self, _request: object) -> dict[str, Any]:
        header = {"stamp": self._node.clock.now_ns(), "frame_id": self._settings.map_frame}
        states = {
            "header": header,
            "trajectory_id": [0],
            "trajectory_state": [_FINISHED if self.is_finished else _ACTIVE],
        }
        return {**self._status(_OK, ""), "trajectory_states": states}

    async def _on_write(self, request: Any) -> dict[str, Any]:
        try:
            async with self._access:
                path = await asyncio.to_thread(write_graph, Path(request.filename), self._slam)
        except (UsageError, ValueError) as error:
            return self._status(_INVALID, str(error))
        return self._status(_OK, f"the graph is saved as {path}, in a format of its own")
