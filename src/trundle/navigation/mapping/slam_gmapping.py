"""gmapping/slam_gmapping: makes a map while the robot is localized in it."""

import asyncio
import math
from collections import deque
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from trundle.gazebo.nodes import NodeHost
from trundle.gazebo.nodes.private_parameters import private_parameters
from trundle.gazebo.nodes.rate import LogThrottle
from trundle.robots.parameters import ParamError
from trundle.ros import Node, Transform, TransformBroadcaster, TransformError, to_nsec
from trundle.spatial import NS_PER_S, Pose

from ..pose_messages import PlanarPose, from_planar
from ..scan_messages import read_ranges
from ..transform_filter import TransformFilter
from . import _mapping
from .gmapping_settings import MapFrame, read_settings

if TYPE_CHECKING:
    from trundle.ros.message_types import sensor_msgs

_SEED = 1
_QUEUE = 5


class SlamGmapping:
    """Publishes `map`, `map_metadata`, `~entropy` and the transform of the odometry frame from `scan` and tf.

    Parameters, with the original's names and defaults: `GmappingSettings`. Service `dynamic_map`. Random numbers have
    a fixed seed. The map reaches from xmin and ymin to xmax and ymax, and grows with what is seen. Scans of one laser
    are used, with the number of beams of the first.
    """

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node
        self._slam: _mapping.GridSlam | None = None
        self._map_from_odom = Pose()
        self._map: dict[str, Any] | None = None
        self._map_ns: int | None = None
        self._frame: MapFrame | None = None
        self._count = 0
        self._pending: deque[sensor_msgs.LaserScan] = deque(maxlen=_QUEUE)
        self._is_pending = asyncio.Event()

    async def run(self) -> int:
        """Map until cancelled."""
        node = self._node
        try:
            self._settings = read_settings(await private_parameters(node))
        except ParamError as error:
            node.log.fatal(str(error))
            return 1
        self._warnings = LogThrottle(node, 5.0)
        self._maps = node.advertise("map", "nav_msgs/OccupancyGrid", latch=True, queue_size=1)
        self._metadata = node.advertise("map_metadata", "nav_msgs/MapMetaData", latch=True, queue_size=1)
        self._entropy = node.advertise("~entropy", "std_msgs/Float64", latch=True, queue_size=1)
        self._broadcaster = TransformBroadcaster(node)
        node.advertise_service("dynamic_map", "nav_msgs/GetMap", self._get_map)
        self._scans = TransformFilter(node, self._settings.odom_frame, self._on_scan, queue_size=_QUEUE)
        node.subscribe("scan", "sensor_msgs/LaserScan", self._scans.add, queue_size=_QUEUE)
        async with asyncio.TaskGroup() as tasks:
            mapping = tasks.create_task(self._process_scans())
            broadcasting = tasks.create_task(self._broadcast())
            await node.closed.wait()
            mapping.cancel()
            broadcasting.cancel()
        return 0

    # -- scans

    def _on_scan(self, scan: "sensor_msgs.LaserScan") -> None:
        self._count += 1
        if self._count % max(self._settings.throttle_scans, 1) == 0:
            self._pending.append(scan)
            self._is_pending.set()

    async def _process_scans(self) -> None:
        """Process one scan after another in a worker thread; simulated time waits for it."""
        while True:
            await self._is_pending.wait()
            with self._node.loop.work.pending("the map"):
                while self._pending:
                    await self._process(self._pending.popleft())
            self._is_pending.clear()

    async def _process(self, scan: "sensor_msgs.LaserScan") -> None:
        settings, stamp_ns = self._settings, to_nsec(scan.header.stamp)
        ranges = read_ranges(scan)
        try:
            odom_from_laser = self._scans.buffer.lookup_transform(
                settings.odom_frame, scan.header.frame_id, stamp_ns
            ).pose
            odometry = _heading_pose(odom_from_laser)
            slam = self._slam or self._start(scan, odom_from_laser)
        except (TransformError, ValueError) as error:
            self._warnings.warn(f"a scan is skipped: {error}")
            return
        if ranges.size != self._bearings.size:
            self._warnings.warn(f"a scan is skipped: it has {ranges.size} beams, the first had {self._bearings.size}")
            return
        ranges[ranges < scan.range_min] = math.inf  # a range below the minimum means that nothing was measured
        if not await asyncio.to_thread(slam.process, odometry, stamp_ns / NS_PER_S, ranges):
            return
        map_from_laser = from_planar(*slam.pose)
        self._map_from_odom = map_from_laser @ from_planar(*odometry).inverse()
        self._entropy.publish({"data": slam.entropy})
        if slam.unmatched_share == 1.0:
            self._warnings.warn("scan matching failed, the odometry is used; is minimumScore too high?")
        now_ns = self._node.clock.now_ns()
        if self._map_ns is None or now_ns - self._map_ns > settings.map_update_interval * NS_PER_S:
            self._map_ns = now_ns
            await self._publish_map(slam)

    def _start(self, scan: "sensor_msgs.LaserScan", odom_from_laser: Pose) -> _mapping.GridSlam:
        """Begin with the laser at its pose in the odometry frame, which is the map's frame at first."""
        angles = scan.angle_min + scan.angle_increment * np.arange(len(scan.ranges), dtype=np.float64)
        is_upside_down = odom_from_laser.transform_vector((0.0, 0.0, 1.0))[2] < 0.0
        self._bearings: NDArray[np.float64] = -angles if is_upside_down else angles
        options = self._settings.slam_options(range_max_m=float(scan.range_max))
        self._slam = _mapping.GridSlam(options, self._bearings, _heading_pose(odom_from_laser), seed=_SEED)
        return self._slam

    # -- the map

    async def _publish_map(self, slam: _mapping.GridSlam) -> None:
        settings = self._settings
        seen = await asyncio.to_thread(slam.seen)
        self._frame = (self._frame or settings.frame).grown(seen, settings.delta)
        first_column, first_row, width, height = self._frame
        cells = await asyncio.to_thread(
            slam.draw,
            first_column=first_column,
            first_row=first_row,
            width=width,
            height=height,
            occupied_threshold=settings.occ_thresh,
        )
        stamp_ns = self._node.clock.now_ns()
        position = {"x": first_column * settings.delta, "y": first_row * settings.delta}
        info = {
            "map_load_time": stamp_ns,
            "resolution": settings.delta,
            "width": width,
            "height": height,
            "origin": {"position": position, "orientation": {"w": 1.0}},
        }
        header = {"stamp": stamp_ns, "frame_id": settings.map_frame}
        self._map = {"header": header, "info": info, "data": cells.reshape(-1)}
        self._maps.publish(self._map)
        self._metadata.publish(info)

    def _get_map(self, _request: object) -> dict[str, Any]:
        return {} if self._map is None else {"map": self._map}

    # -- tf

    async def _broadcast(self) -> None:
        period_s = self._settings.transform_publish_period
        if period_s <= 0.0:
            return
        delay_ns = round(self._settings.tf_delay * NS_PER_S)
        while True:
            self._broadcaster.send_transform(
                Transform(
                    parent=self._settings.map_frame,
                    child=self._settings.odom_frame,
                    stamp_ns=self._node.clock.now_ns() + delay_ns,
                    translation=self._map_from_odom.position,
                    rotation=self._map_from_odom.quaternion,
                )
            )
            await self._node.clock.sleep(period_s)


def _heading_pose(odom_from_laser: Pose) -> PlanarPose:
    """Return the laser's place and the direction of its x axis, upside down too."""
    x, y, _ = odom_from_laser.transform_vector((1.0, 0.0, 0.0))
    return odom_from_laser.position[0], odom_from_laser.position[1], math.atan2(y, x)
