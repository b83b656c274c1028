"""Node that maps by a pose graph with odometry: what slam_karto and slam_toolbox share."""

import asyncio
from collections.abc import Coroutine, Mapping
from typing import TYPE_CHECKING, Any, ClassVar, Generic, TypeVar

from trundle.gazebo.nodes import NodeHost
from trundle.gazebo.nodes.private_parameters import private_parameters
from trundle.gazebo.nodes.rate import LogThrottle, Rate
from trundle.robots.parameters import ParamError
from trundle.ros import Node, Transform, TransformBroadcaster, TransformError, to_nsec
from trundle.spatial import NS_PER_S, Pose

from ..pose_messages import PlanarPose, from_planar, planar
from ..scan_queue import ScanQueue
from ..settings import read_settings
from ..transform_filter import TransformFilter
from . import _mapping
from .graph_map import GraphMap, graph_markers
from .karto_settings import KartoSettings, unused_parameters
from .scan_points import read_points

if TYPE_CHECKING:
    from trundle.ros.message_types import sensor_msgs

Settings = TypeVar("Settings", bound=KartoSettings)


class GraphMappingNode(Generic[Settings]):
    """Publishes a map and the transform of the odometry frame from scans and tf."""

    kind: type[Settings]
    """Type of its parameters."""
    queue_size = 5
    aliases: ClassVar[Mapping[str, str]] = {}
    """Older names of parameters → names."""

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node
        self._odometry: PlanarPose | None = None
        """Pose of the robot in the odometry's frame at the last scan."""
        self._map_from_odom = Pose()
        self._map_ns: int | None = None
        """Time when the map was drawn."""
        self._count = 0
        self._access = asyncio.Lock()
        """Held while the graph is changed or read, which other threads do."""

    async def run(self) -> int:
        """Map until cancelled."""
        node = self._node
        try:
            parameters = (await private_parameters(node)).renamed(self.aliases)
            settings = self._settings = read_settings(self.kind, parameters)
        except ParamError as error:
            node.log.fatal(str(error))
            return 1
        if unused := unused_parameters(parameters, {*settings.__struct_fields__, *self.aliases}):
            node.log.info(unused)
        self._base, self._odom, self._frame = (
            frame.lstrip("/") for frame in (settings.base_frame, settings.odom_frame, settings.map_frame)
        )
        self._restart()
        self._warnings = LogThrottle(node, 5.0)
        self._broadcaster = TransformBroadcaster(node)
        self._queue = ScanQueue(node, self._take, size=self.queue_size)
        self._scans = TransformFilter(node, self._odom, self._receive, queue_size=self.queue_size)
        self._advertise(settings)
        await self._begin(settings)
        node.subscribe(self._scan_topic(settings), "sensor_msgs/LaserScan", self._scans.add, queue_size=self.queue_size)
        async with asyncio.TaskGroup() as tasks:
            jobs = [tasks.create_task(job) for job in self._jobs(settings)]
            await node.closed.wait()
            for job in jobs:
                job.cancel()
        return 0

    # -- what differs

    def _scan_topic(self, settings: Settings) -> str:
        del settings
        return "scan"

    def _options(self, settings: Settings) -> _mapping.GraphOptions:
        return settings.graph_options()

    def _advertise(self, settings: Settings) -> None:
        """Advertise topics and services."""
        raise NotImplementedError

    async def _begin(self, settings: Settings) -> None:
        """Prepare what the first scan needs."""

    def _jobs(self, settings: Settings) -> list[Coroutine[Any, Any, None]]:
        """Return what runs until the node ends."""
        return [self._queue.run(), self._broadcast(settings.transform_publish_period)]

    def _on_used(self, stamp_ns: int) -> None:
        """React to a scan that became a node."""

    # -- scans

    def _restart(self, slam: _mapping.GraphSlam | None = None) -> None:
        """Go on with a graph; None: a new one."""
        self._slam = slam or _mapping.GraphSlam(self._options(self._settings))
        self._map = GraphMap(self._slam, frame=self._frame, resolution=self._settings.resolution)
        self._odometry = self._map_ns = None
        self._map_from_odom = Pose()

    def _receive(self, scan: "sensor_msgs.LaserScan") -> None:
        self._count += 1
        if self._count % self._settings.throttle_scans == 0:
            self._queue.add(scan)

    async def _take(self, scan: "sensor_msgs.LaserScan") -> None:
        async with self._access:
            await self._process(scan)

    async def _process(self, scan: "sensor_msgs.LaserScan") -> None:
        stamp_ns, laser, buffer = to_nsec(scan.header.stamp), scan.header.frame_id, self._scans.buffer
        try:
            base_from_laser = buffer.lookup_transform(self._base, laser, stamp_ns).pose
            odom_from_laser = buffer.lookup_transform(self._odom, laser, stamp_ns).pose
            points = read_points(scan, base_from_laser, usable_range=self._usable_range)
        except (TransformError, ValueError) as error:
            self._warnings.warn(f"a scan is skipped: {error}")
            return
        odom_from_base = from_planar(*planar(odom_from_laser @ base_from_laser.inverse()))
        motion = Pose()
        if self._odometry is not None:
            motion = from_planar(*self._odometry).inverse() @ odom_from_base
        elif not len(self._slam.poses()):
            self._slam.set_pose(planar(odom_from_base))  # the map's frame is the odometry's at first
        self._odometry = planar(odom_from_base)
        is_used = await asyncio.to_thread(self._slam.process, planar(motion), stamp_ns / NS_PER_S, *points)
        self._map_from_odom = from_planar(*self._slam.pose) @ odom_from_base.inverse()
        if not is_used:
            return
        self._on_used(stamp_ns)
        now_ns, interval_ns = self._node.clock.now_ns(), self._settings.map_update_interval * NS_PER_S
        if self._map_ns is None or now_ns - self._map_ns >= interval_ns or now_ns < self._map_ns:
            self._map_ns = now_ns
            await self._publish_map()

    @property
    def _usable_range(self) -> float:
        """Longer beams are free up to there [m]."""
        return 12.0

    # -- what comes of it

    def _advertise_map(self, topic: str, metadata: str, service: str) -> None:
        node = self._node
        self._maps = node.advertise(topic, "nav_msgs/OccupancyGrid", latch=True, queue_size=1)
        self._metadata = node.advertise(metadata, "nav_msgs/MapMetaData", latch=True, queue_size=1)
        node.advertise_service(service, "nav_msgs/GetMap", self._get_map)

    async def _publish_map(self) -> None:
        if await self._map.draw(self._node.clock.now_ns()) and self._map.message is not None:
            self._maps.publish(self._map.message)
            self._metadata.publish(self._map.message["info"])

    def _get_map(self, _request: object) -> dict[str, Any]:
        return {} if self._map.message is None else {"map": self._map.message}

    async def _publish_markers(self, topic: str, period_s: float) -> None:
        markers = self._node.advertise(topic, "visualization_msgs/MarkerArray", queue_size=1)
        rate = Rate(self._node, 1.0 / max(period_s, 0.01))
        while True:
            await rate.sleep()
            if markers.has_subscribers:
                stamp_ns = self._node.clock.now_ns()
                async with self._access:
                    message = graph_markers(self._slam, frame=self._frame, stamp_ns=stamp_ns)
                markers.publish(message)

    async def _broadcast(self, period_s: float, ahead_s: float = 0.0) -> None:
        if period_s <= 0.0:
            return
        while True:
            pose = self._map_from_odom
            self._broadcaster.send_transform(
                Transform(
                    parent=self._frame,
                    child=self._odom,
                    stamp_ns=self._node.clock.now_ns() + round(ahead_s * NS_PER_S),
                    translation=pose.position,
                    rotation=pose.quaternion,
                )
            )
            await self._node.clock.sleep(period_s)
