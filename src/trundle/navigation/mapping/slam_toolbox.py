"""slam_toolbox's nodes: maps by a pose graph that is saved, loaded and continued, and localization in it."""

import asyncio
from collections.abc import Coroutine
from pathlib import Path
from typing import Annotated, Any

import numpy as np
from msgspec import Meta

from trundle.base.diagnostics import UsageError
from trundle.gazebo.nodes.map_server.occupancy_grid import OccupancyGrid, write_map
from trundle.gazebo.nodes.private_parameters import private_parameters
from trundle.robots.parameters import ParamError
from trundle.ros import ServiceError

from ..pose_messages import PlanarPose, from_planar, planar, pose_fields, read_pose
from . import _mapping
from .graph_file import read_graph, write_graph
from .graph_node import GraphMappingNode
from .karto_settings import Count, KartoSettings, Length

_AT_FIRST_NODE = 1
_SYNC_QUEUE = 1000
_MARKER_PERIOD_S = 2.0
_OCCUPIED, _FREE = 65, 25


class SlamToolboxSettings(KartoSettings):
    """Lengths [m], angles [rad], times [s]."""

    base_frame: str = "base_footprint"
    map_name: str = "/map"
    scan_topic: str = "/scan"
    map_file_name: str = ""
    map_start_at_dock: bool = False
    max_laser_range: Annotated[float, Meta(ge=0.1, le=1e6)] = 25.0
    minimum_time_interval: Length = 0.5
    transform_timeout: Length = 0.2
    position_covariance_scale: Length = 1.0
    yaw_covariance_scale: Length = 1.0
    throttle_scans: Count = 1

    def graph_options(self) -> _mapping.GraphOptions:
        """Return the options of the graph."""
        options = super().graph_options()
        options.least_time = self.minimum_time_interval
        return options


class SlamToolbox(GraphMappingNode[SlamToolboxSettings]):
    """Publishes `map`, `map_metadata`, `~pose`, `~graph_visualization` and the transform of the odometry frame.

    Parameters, with the original's names and defaults: `SlamToolboxSettings`, map_start_pose; those of solvers have no
    effect. Services below its name: `dynamic_map`, `save_map`, `serialize_map`, `deserialize_map`, `reset`,
    `pause_new_measurements`, `clear_queue`. Graphs are files of its own, NAME.posegraph. The interactive mode is left
    out.
    """

    kind = SlamToolboxSettings
    extends_map = True

    def _options(self, settings: SlamToolboxSettings) -> _mapping.GraphOptions:
        options = super()._options(settings)
        options.extends_map = self.extends_map
        return options

    @property
    def _usable_range(self) -> float:
        return self._settings.max_laser_range

    def _scan_topic(self, settings: SlamToolboxSettings) -> str:
        return settings.scan_topic

    def _advertise(self, settings: SlamToolboxSettings) -> None:
        node, package = self._node, "slam_toolbox_msgs"
        self._is_paused = False
        self._advertise_map(settings.map_name, f"{settings.map_name}_metadata", "~dynamic_map")
        self._poses = node.advertise("~pose", "geometry_msgs/PoseWithCovarianceStamped", latch=True, queue_size=10)
        node.advertise_service("~pause_new_measurements", f"{package}/Pause", self._on_pause)
        node.advertise_service("~serialize_map", f"{package}/SerializePoseGraph", self._on_serialize)
        node.advertise_service("~deserialize_map", f"{package}/DeserializePoseGraph", self._on_deserialize)
        node.advertise_service("~reset", f"{package}/Reset", self._on_reset)
        node.advertise_service("~clear_queue", f"{package}/ClearQueue", self._on_clear)
        if self.extends_map:
            node.advertise_service("~save_map", f"{package}/SaveMap", self._on_save)

    async def _begin(self, settings: SlamToolboxSettings) -> None:
        if not settings.map_file_name:
            return
        parameters = await private_parameters(self._node)
        try:
            pose = parameters.numbers("map_start_pose", 3, (0.0, 0.0, 0.0))
        except ParamError as error:
            self._node.log.error(f"the map starts at its origin: {error}")
            pose = (0.0, 0.0, 0.0)
        is_at_dock = settings.map_start_at_dock and "map_start_pose" not in parameters
        await self._load(settings.map_file_name, None if is_at_dock else (pose[0], pose[1], pose[2]))

    def _jobs(self, settings: SlamToolboxSettings) -> list[Coroutine[Any, Any, None]]:
        broadcast = self._broadcast(settings.transform_publish_period, settings.transform_timeout)
        return [self._queue.run(), broadcast, self._publish_markers("~graph_visualization", _MARKER_PERIOD_S)]

    async def _process(self, scan: Any) -> None:
        if not self._is_paused:
            await super()._process(scan)

    def _on_used(self, stamp_ns: int) -> None:
        settings = self._settings
        xx, xy, yy, _, _, tt = self._slam.covariance
        covariance = np.zeros((6, 6))
        covariance[:2, :2] = settings.position_covariance_scale * np.array([[xx, xy], [xy, yy]])
        covariance[5, 5] = settings.yaw_covariance_scale * tt
        pose = {"pose": pose_fields(from_planar(*self._slam.pose)), "covariance": covariance.ravel().tolist()}
        self._poses.publish({"header": {"stamp": stamp_ns, "frame_id": self._frame}, "pose": pose})

    # -- services

    def _on_pause(self, _request: object) -> dict[str, Any]:
        self._is_paused = not self._is_paused
        self._node.log.info("new scans are left out" if self._is_paused else "new scans are used")
        return {"status": True}

    def _on_clear(self, _request: object) -> dict[str, Any]:
        self._queue.clear()
        return {"status": True}

    async def _on_reset(self, request: Any) -> dict[str, Any]:
        async with self._access:
            self._restart()
        self._queue.clear()
        self._is_paused = bool(request.pause_new_measurements)
        return {"result": 0}

    async def _on_save(self, request: Any) -> dict[str, Any]:
        name = Path(request.name.data or "map")
        async with self._access:
            is_drawn = await self._map.draw(self._node.clock.now_ns())
        if not is_drawn or self._map.message is None:
            raise ServiceError("there is no map yet")
        info, data = self._map.message["info"], self._map.message["data"]
        position = info["origin"]["position"]
        grid = OccupancyGrid(
            cells=data.reshape(info["height"], info["width"]),
            resolution_m=info["resolution"],
            origin=(position["x"], position["y"], 0.0),
        )
        try:
            await asyncio.to_thread(write_map, name, grid, occupied=_OCCUPIED, free=_FREE)
        except (UsageError, ValueError) as error:
            raise ServiceError(str(error)) from None
        self._node.log.info(f"the map is saved as {name}.pgm and {name}.yaml")
        return {}

    async def _on_serialize(self, request: Any) -> dict[str, Any]:
        async with self._access:
            if not len(self._slam.poses()):
                raise ServiceError("there is no graph yet")
            try:
                path = await asyncio.to_thread(write_graph, Path(request.filename), self._slam)
            except (UsageError, ValueError) as error:
                raise ServiceError(str(error)) from None
        self._node.log.info(f"the graph is saved as {path}")
        return {}

    async def _on_deserialize(self, request: Any) -> dict[str, Any]:
        pose = request.initial_pose
        start = None if request.match_type == _AT_FIRST_NODE else (pose.x, pose.y, pose.theta)
        if not await self._load(request.filename, start):
            raise ServiceError(f"{request.filename} is not loaded; the log says why")
        return {}

    async def _load(self, name: str, start: PlanarPose | None) -> bool:
        """Go on with a saved graph, from a pose in it; None: its first."""
        slam = _mapping.GraphSlam(self._options(self._settings))
        try:
            await asyncio.to_thread(read_graph, Path(name), slam)
            x, y, yaw = slam.poses()[0].tolist() if start is None else start
            slam.set_pose((x, y, yaw))
        except (UsageError, ValueError) as error:
            self._node.log.error(f"the graph is not loaded: {error}")
            return False
        async with self._access:
            self._restart(slam)
            await self._publish_map()
        return True


class AsyncSlamToolbox(SlamToolbox):
    """SlamToolbox that drops scans that it is late for."""

    queue_size = 1


class SyncSlamToolbox(SlamToolbox):
    """SlamToolbox that keeps up to a thousand scans waiting."""

    queue_size = _SYNC_QUEUE


class LocalizationSlamToolbox(AsyncSlamToolbox):
    """SlamToolbox in a saved graph, which it does not change: map_file_name, map_start_pose, topic `initialpose`."""

    extends_map = False

    def _advertise(self, settings: SlamToolboxSettings) -> None:
        super()._advertise(settings)
        node = self._node
        self._start: PlanarPose | None = None
        """Pose that was given for the next scan."""
        node.subscribe("/initialpose", "geometry_msgs/PoseWithCovarianceStamped", self._on_pose, queue_size=1)
        node.advertise_service("~clear_localization_buffer", "std_srvs/Empty", lambda _request: {})

    def _on_pose(self, message: Any) -> None:
        try:
            self._start = planar(read_pose(message.pose.pose))
        except ValueError as error:
            self._node.log.warn(f"an initial pose is ignored: {error}")

    async def _process(self, scan: Any) -> None:
        if self._start is not None:
            self._slam.set_pose(self._start)
            self._start = None
        await super()._process(scan)
