"""cartographer_ros/cartographer_node: makes a map by a pose graph, with or without odometry."""

import asyncio
import math
from collections import deque
from pathlib import Path
from typing import TYPE_CHECKING, Any

from trundle.base.diagnostics import UsageError
from trundle.gazebo.nodes import NodeHost
from trundle.gazebo.nodes.rate import LogThrottle
from trundle.ros import Node, Transform, TransformBroadcaster, TransformError, to_nsec
from trundle.spatial import NS_PER_S, Pose

from ..pose_messages import PlanarPose, from_planar, planar, pose_fields, read_pose
from ..scan_queue import ScanQueue
from ..transform_filter import TransformFilter
from . import _mapping
from .cartographer_services import CartographerServices
from .cartographer_settings import CartographerSettings, read_configuration
from .scan_points import read_points

if TYPE_CHECKING:
    from trundle.ros.message_types import sensor_msgs

_QUEUE = 5
_LEAST_PERIOD_S = 0.02
"""Of published poses: the original's 5 ms serve nobody here."""
_LONGEST_EXTRAPOLATION_S = 0.5
_KEPT_ODOMETRY = 200


class CartographerNode:
    """Publishes transforms, `submap_list` and `trajectory_node_list` from `scan`, or `scan_1` and others, and `odom`.

    Arguments: -configuration_directory and -configuration_basename, a configuration in Lua, whose tables, includes and
    assignments are read; what has no effect is said in the log. 2D, of laser scans: multi-echo scans, point clouds,
    landmarks and satellite fixes are left out. Services `submap_query`, `trajectory_query`, `finish_trajectory`,
    `get_trajectory_states` and `write_state`, which writes a graph of its own. The graph is one submap.
    """

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del host
        self._node = node
        self._arguments = arguments
        self._access = asyncio.Lock()
        self._odometry: deque[tuple[int, Pose]] = deque(maxlen=_KEPT_ODOMETRY)
        """Stamps [ns] and poses of the tracking frame in the odometry's."""
        self._held: deque[sensor_msgs.LaserScan] = deque(maxlen=_QUEUE)
        """Scans that wait for odometry."""
        self._turned = 0.0
        """Turn that the imu measured [rad]."""
        self._imu_ns: int | None = None
        self._last: tuple[int, PlanarPose, Pose | None, float] | None = None
        """Stamp [ns] of the last scan, local pose, odometry and turn at it."""
        self._velocity: PlanarPose = (0.0, 0.0, 0.0)
        """In the tracking frame [m / s], [rad / s]."""

    async def run(self) -> int:
        """Map until cancelled; exit code 1 without a configuration."""
        node = self._node
        try:
            settings = self._settings = self._configured()
        except UsageError as error:
            node.log.fatal(str(error))
            return 1
        left_out = [
            name
            for name, count in (
                ("multi-echo scans", settings.num_multi_echo_laser_scans),
                ("point clouds", settings.num_point_clouds),
            )
            if count
        ]
        if left_out:
            node.log.error(f"{' and '.join(left_out)} are left out; laser scans are used")
        self._slam = _mapping.GraphSlam(settings.graph_options())
        self._warnings = LogThrottle(node, 5.0)
        self._broadcaster = TransformBroadcaster(node)
        self._queue = ScanQueue(node, self._take, size=_QUEUE * max(settings.num_laser_scans, 1))
        self._scans = TransformFilter(node, settings.tracking_frame, self._receive, queue_size=_QUEUE)
        self._services = CartographerServices(node, self._slam, self._access, settings)
        self._tracked = node.advertise("tracked_pose", "geometry_msgs/PoseStamped", queue_size=1)
        self._subscribe(settings)
        async with asyncio.TaskGroup() as tasks:
            jobs = [tasks.create_task(job) for job in (self._queue.run(), self._broadcast(), *self._services.jobs())]
            await node.closed.wait()
            for job in jobs:
                job.cancel()
        return 0

    def _configured(self) -> CartographerSettings:
        options = read_arguments(self._arguments)
        folder, name = options.get("configuration_directory", ""), options.get("configuration_basename", "")
        if not folder or not name:
            raise UsageError(
                "usage: cartographer_node -configuration_directory FOLDER -configuration_basename FILE.lua"
            )
        if "load_state_filename" in options:
            self._node.log.error("-load_state_filename: states of the original cannot be read; the map starts empty")
        settings, unused = read_configuration(Path(folder), name)
        if unused:
            self._node.log.info(unused)
        if not settings.num_laser_scans:
            raise UsageError(f"{Path(folder) / name}: num_laser_scans is 0; only laser scans are built in")
        return settings

    def _subscribe(self, settings: CartographerSettings) -> None:
        node, count = self._node, settings.num_laser_scans
        for topic in ["scan"] if count == 1 else [f"scan_{number + 1}" for number in range(count)]:
            node.subscribe(topic, "sensor_msgs/LaserScan", self._scans.add, queue_size=_QUEUE)
        if settings.use_odometry:
            node.subscribe("odom", "nav_msgs/Odometry", self._on_odometry, queue_size=None)
        elif settings.use_imu_data:
            node.subscribe("imu", "sensor_msgs/Imu", self._on_imu, queue_size=None)

    # -- what predicts the motion

    def _on_odometry(self, message: Any) -> None:
        try:
            pose = read_pose(message.pose.pose)
            child = message.child_frame_id.lstrip("/") or self._settings.tracking_frame
            offset = self._lookup(child, self._settings.tracking_frame, 0)
        except (ValueError, TransformError) as error:
            self._warnings.warn(f"an odometry is left out: {error}")
            return
        self._odometry.append((to_nsec(message.header.stamp), pose @ offset))
        while self._held and to_nsec(self._held[0].header.stamp) <= self._odometry[-1][0]:
            self._queue.add(self._held.popleft())

    def _on_imu(self, message: Any) -> None:
        stamp_ns, rate = to_nsec(message.header.stamp), message.angular_velocity.z
        if self._imu_ns is not None and math.isfinite(rate) and 0 < stamp_ns - self._imu_ns < NS_PER_S:
            self._turned += rate * (stamp_ns - self._imu_ns) / NS_PER_S
        self._imu_ns = stamp_ns

    def _odometry_at(self, stamp_ns: int) -> Pose | None:
        """Return the last pose before a time, moved on by its neighbors' velocity; None: none came yet."""
        before = [entry for entry in self._odometry if entry[0] <= stamp_ns]
        after = next((entry for entry in self._odometry if entry[0] > stamp_ns), None)
        if not before:
            return None if after is None else after[1]
        then_ns, then = before[-1]
        if after is None:
            return then
        x, y, yaw = planar(then.inverse() @ after[1])
        part = (stamp_ns - then_ns) / (after[0] - then_ns)
        return then @ from_planar(part * x, part * y, part * yaw)

    def _predict(self, stamp_ns: int, odometry: Pose | None) -> PlanarPose:
        """Return the motion since the last scan."""
        if self._last is None:
            return 0.0, 0.0, 0.0
        then_ns, _, then, turned = self._last
        if then is not None and odometry is not None:
            return planar(then.inverse() @ odometry)
        seconds = max((stamp_ns - then_ns) / NS_PER_S, 0.0)
        if seconds > _LONGEST_EXTRAPOLATION_S:
            seconds = 0.0
        x, y, yaw = (seconds * value for value in self._velocity)
        return x, y, yaw if self._imu_ns is None else self._turned - turned

    # -- scans

    def _receive(self, scan: "sensor_msgs.LaserScan") -> None:
        """Pass a scan on, once there is odometry of its time."""
        is_early = not self._odometry or self._odometry[-1][0] < to_nsec(scan.header.stamp)
        (self._held.append if self._settings.use_odometry and is_early else self._queue.add)(scan)

    async def _take(self, scan: "sensor_msgs.LaserScan") -> None:
        if self._services.is_finished:
            return
        async with self._access:
            await self._process(scan)

    async def _process(self, scan: "sensor_msgs.LaserScan") -> None:
        stamp_ns, settings = to_nsec(scan.header.stamp), self._settings
        try:
            points = read_points(
                scan,
                self._lookup(settings.tracking_frame, scan.header.frame_id, stamp_ns),
                usable_range=settings.max_range,
                min_range=settings.min_range,
                miss_range=settings.missing_data_ray_length,
            )
        except (TransformError, ValueError) as error:
            self._warnings.warn(f"a scan is skipped: {error}")
            return
        odometry = self._odometry_at(stamp_ns)
        motion = self._predict(stamp_ns, odometry)
        is_used = await asyncio.to_thread(self._slam.process, motion, stamp_ns / NS_PER_S, *points)
        local = planar(from_planar(*self._slam.correction).inverse() @ from_planar(*self._slam.pose))
        if self._last is not None and stamp_ns > self._last[0]:
            moved = planar(from_planar(*self._last[1]).inverse() @ from_planar(*local))
            seconds = (stamp_ns - self._last[0]) / NS_PER_S
            self._velocity = (moved[0] / seconds, moved[1] / seconds, moved[2] / seconds)
        self._last = (stamp_ns, local, odometry, self._turned)
        if is_used:
            self._services.count()
        if settings.publish_tracked_pose:
            header = {"stamp": stamp_ns, "frame_id": settings.map_frame}
            self._tracked.publish({"header": header, "pose": pose_fields(from_planar(*self._slam.pose))})

    def _lookup(self, target: str, source: str, stamp_ns: int) -> Pose:
        source = source.lstrip("/")
        return Pose() if target == source else self._scans.buffer.lookup_transform(target, source, stamp_ns).pose

    # -- tf

    async def _broadcast(self) -> None:
        settings = self._settings
        period_s = max(settings.pose_publish_period_sec, _LEAST_PERIOD_S)
        last_ns = 0
        while True:
            await self._node.clock.sleep(period_s)
            if self._last is None or not settings.publish_to_tf:
                continue
            stamp_ns = self._node.clock.now_ns()
            if stamp_ns <= last_ns:
                continue
            last_ns = stamp_ns
            try:
                self._publish(stamp_ns)
            except TransformError as error:
                self._warnings.warn(f"no pose is published: {error}")

    def _publish(self, stamp_ns: int) -> None:
        """Publish where the robot is by now: in the map, and with provide_odom_frame in the local frame."""
        assert self._last is not None, "there was a scan"
        settings = self._settings
        tracking, published = settings.tracking_frame, settings.published_frame
        local_from_tracking = from_planar(*self._last[1])
        tracking_from_published = self._lookup(tracking, published, self._last[0])
        if self._lookup(tracking, published, 0) == tracking_from_published:  # it moves with the robot, unlike odom
            local_from_tracking @= from_planar(*self._predict(stamp_ns, self._odometry_at(stamp_ns)))
        local_from_published = local_from_tracking @ tracking_from_published
        map_from_local = from_planar(*self._slam.correction)
        if settings.provide_odom_frame:
            self._send(settings.map_frame, settings.odom_frame, map_from_local, stamp_ns)
            self._send(settings.odom_frame, published, local_from_published, stamp_ns)
        else:
            self._send(settings.map_frame, published, map_from_local @ local_from_published, stamp_ns)

    def _send(self, parent: str, child: str, pose: Pose, stamp_ns: int) -> None:
        self._broadcaster.send_transform(
            Transform(
                parent=parent, child=child, stamp_ns=stamp_ns, translation=pose.position, rotation=pose.quaternion
            )
        )


def read_arguments(arguments: list[str]) -> dict[str, str]:
    """Read options as glog's: -name value, --name=value; one without a value is `true`."""
    options: dict[str, str] = {}
    rest = deque(arguments)
    while rest:
        argument = rest.popleft()
        if not argument.startswith("-"):
            continue
        name, has_value, value = argument.lstrip("-").partition("=")
        if not has_value:
            value = rest.popleft() if rest and not rest[0].startswith("-") else "true"
        options[name] = value
    return options
