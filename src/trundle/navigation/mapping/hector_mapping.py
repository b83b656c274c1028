"""hector_mapping/hector_mapping: makes a map from scans, without odometry."""

import asyncio
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from trundle.gazebo.nodes import NodeHost
from trundle.gazebo.nodes.private_parameters import private_parameters
from trundle.gazebo.nodes.rate import LogThrottle, Rate
from trundle.robots.parameters import ParamError
from trundle.ros import Node, Transform, TransformBroadcaster, TransformError, to_nsec
from trundle.spatial import Pose, transform_points

from ..pose_messages import PlanarPose, from_planar, planar, pose_fields, read_pose
from ..scan_messages import beam_ends
from ..scan_queue import ScanQueue
from ..settings import read_settings
from ..transform_filter import TransformFilter
from . import _mapping
from .hector_settings import HectorSettings

if TYPE_CHECKING:
    from trundle.ros.message_types import sensor_msgs

_LOST_SCORE = 0.1
"""Mean probability of an obstacle at the beams' ends; below it, a scan counts as not matched."""


class HectorMapping:
    """Publishes `map`, `slam_out_pose`, `poseupdate` and the transforms of the odometry frame and the matched pose.

    Parameters, with the original's names and defaults: `HectorSettings`. Topics `syscommand` (reset) and `initialpose`;
    services `dynamic_map`, `reset_map`, `pause_mapping`, `restart_mapping_with_new_pose`. A scan is matched with three
    grids, from coarse to fine, by Gauss-Newton steps. Debug output and drawings are not published.
    """

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node
        self._start: PlanarPose | None = None
        """Pose that was given for the next scan."""
        self._is_paused = False
        self._is_changed = True
        self._map: dict[str, Any] = {}

    async def run(self) -> int:
        """Map until cancelled."""
        node = self._node
        try:
            settings = self._settings = read_settings(HectorSettings, await private_parameters(node))
        except ParamError as error:
            node.log.fatal(str(error))
            return 1
        self._slam = _mapping.HectorSlam(settings.slam_options())
        self._warnings = LogThrottle(node, 5.0)
        self._base, self._odom, self._frame = (
            frame.lstrip("/") for frame in (settings.base_frame, settings.odom_frame, settings.map_frame)
        )
        self._advertise(settings)
        size = settings.scan_subscriber_queue_size
        self._queue = queue = ScanQueue(node, self._process, size=size)
        self._scans = TransformFilter(node, self._base, self._align, queue_size=size)
        self._aligned = TransformFilter(node, self._odom, queue.add, queue_size=size)
        receive = self._scans.add if settings.use_tf_scan_transformation else self._align
        node.subscribe(settings.scan_topic, "sensor_msgs/LaserScan", receive, queue_size=size)
        node.subscribe(settings.sys_msg_topic, "std_msgs/String", self._on_command, queue_size=2)
        node.subscribe("initialpose", "geometry_msgs/PoseWithCovarianceStamped", self._on_pose, queue_size=2)
        async with asyncio.TaskGroup() as tasks:
            jobs = [tasks.create_task(queue.run()), tasks.create_task(self._publish_maps())]
            await node.closed.wait()
            for job in jobs:
                job.cancel()
        return 0

    def _advertise(self, settings: HectorSettings) -> None:
        node = self._node
        self._maps = node.advertise("map", "nav_msgs/OccupancyGrid", latch=True, queue_size=1)
        metadata = node.advertise("map_metadata", "nav_msgs/MapMetaData", latch=True, queue_size=1)
        self._update_map()
        metadata.publish(self._map["info"])
        kind = "geometry_msgs/PoseWithCovarianceStamped"
        self._updates = node.advertise(settings.pose_update_topic, kind, queue_size=1)
        self._poses = node.advertise("slam_out_pose", "geometry_msgs/PoseStamped", queue_size=1)
        self._clouds = node.advertise("slam_cloud", "sensor_msgs/PointCloud", queue_size=1)
        has_odometry = settings.pub_odometry
        self._odometry = node.advertise("scanmatch_odom", "nav_msgs/Odometry", queue_size=50) if has_odometry else None
        self._broadcaster = TransformBroadcaster(node)
        if settings.advertise_map_service:
            node.advertise_service("dynamic_map", "nav_msgs/GetMap", self._get_map)
        node.advertise_service("reset_map", "std_srvs/Trigger", self._on_reset)
        node.advertise_service("pause_mapping", "std_srvs/SetBool", self._on_pause)
        kind = "hector_mapping/ResetMapping"
        node.advertise_service("restart_mapping_with_new_pose", kind, self._on_restart)

    # -- commands

    def _reset(self) -> None:
        self._node.log.info("the map and the pose are reset")
        self._slam.reset()
        self._is_changed = True

    def _on_command(self, message: Any) -> None:
        if message.data == "reset":
            self._reset()

    def _on_reset(self, _request: object) -> dict[str, Any]:
        self._reset()
        return {"success": True}

    def _on_pause(self, request: Any) -> dict[str, Any]:
        self._is_paused = bool(request.data)
        return {"success": True}

    def _on_restart(self, request: Any) -> dict[str, Any]:
        self._reset()
        self._set_start(request.initial_pose)
        self._is_paused = False
        return {}

    def _on_pose(self, message: Any) -> None:
        if message.header.frame_id.lstrip("/") not in ("", self._frame):
            self._node.log.warn(f"an initial pose in {message.header.frame_id!r} is ignored; it is not {self._frame!r}")
            return
        self._set_start(message.pose.pose)

    def _set_start(self, pose: Any) -> None:
        try:
            self._start = planar(read_pose(pose))
        except ValueError as error:
            self._node.log.warn(f"an initial pose is ignored: {error}")

    # -- scans

    def _align(self, scan: "sensor_msgs.LaserScan") -> None:
        """Delay a scan until odometry reaches its stamp, if the node uses odometry, and it is published."""
        settings = self._settings
        uses_odometry = settings.pub_map_odom_transform and self._odom != self._base
        if uses_odometry and self._aligned.buffer.can_transform(self._odom, self._base):
            self._aligned.add(scan, self._base)
        else:
            self._queue.add(scan)

    async def _process(self, scan: "sensor_msgs.LaserScan") -> None:
        if self._is_paused:
            return
        stamp_ns, settings = to_nsec(scan.header.stamp), self._settings
        try:
            base_from_laser = self._base_from_laser(scan, stamp_ns)
            ends = self._ends(scan, base_from_laser)
        except (TransformError, ValueError) as error:
            self._warnings.warn(f"a scan is skipped: {error}")
            return
        start, self._start = self._start or self._estimated_start(stamp_ns), None
        x, y, _ = base_from_laser.position
        is_known = settings.map_with_known_poses
        is_entered = await asyncio.to_thread(self._slam.update, start, (x, y), ends, is_known=is_known)
        self._is_changed |= is_entered
        if self._slam.score < _LOST_SCORE and not is_entered:
            self._warnings.warn("a scan does not match the map; did the robot turn too fast?")
        if not is_known:
            self._publish_pose(stamp_ns)

    def _base_from_laser(self, scan: "sensor_msgs.LaserScan", stamp_ns: int) -> Pose:
        if not self._settings.use_tf_scan_transformation:
            return Pose()
        return self._scans.buffer.lookup_transform(self._base, scan.header.frame_id, stamp_ns).pose

    def _ends(self, scan: "sensor_msgs.LaserScan", base_from_laser: Pose) -> NDArray[np.float64]:
        """Return the ends (n, 2) of the used beams in the robot's frame [m]."""
        settings = self._settings
        flat = beam_ends(scan)
        if self._clouds.has_subscribers:
            points = [{"x": x, "y": y} for x, y in flat.tolist()]
            self._clouds.publish({"header": scan.header, "points": points})
        distances = np.hypot(flat[:, 0], flat[:, 1])
        flat = flat[(distances > settings.laser_min_dist) & (distances < settings.laser_max_dist)]
        ends = transform_points(base_from_laser, np.pad(flat, ((0, 0), (0, 1))))
        heights = ends[:, 2] - base_from_laser.position[2]
        is_level = (heights > settings.laser_z_min_value) & (heights < settings.laser_z_max_value)
        return np.ascontiguousarray(ends[is_level, :2])

    def _estimated_start(self, stamp_ns: int) -> PlanarPose:
        if self._settings.use_tf_pose_start_estimate:
            try:
                return planar(self._scans.buffer.lookup_transform(self._frame, self._base, stamp_ns).pose)
            except TransformError as error:
                self._warnings.warn(f"the last pose is used: {error}")
        return self._slam.pose

    # -- results

    def _publish_pose(self, stamp_ns: int) -> None:
        map_from_base = from_planar(*self._slam.pose)
        header = {"stamp": stamp_ns, "frame_id": self._frame}
        pose = pose_fields(map_from_base)
        xx, xy, yy, xt, yt, tt = self._slam.covariance
        covariance = np.zeros((6, 6))
        covariance[np.ix_((0, 1, 5), (0, 1, 5))] = [[xx, xy, xt], [xy, yy, yt], [xt, yt, tt]]
        certain = {"pose": pose, "covariance": covariance.ravel().tolist()}
        self._poses.publish({"header": header, "pose": pose})
        self._updates.publish({"header": header, "pose": certain})
        if self._odometry is not None:
            self._odometry.publish({"header": header, "child_frame_id": self._base, "pose": certain})
        if self._settings.pub_map_scanmatch_transform:
            self._send(self._settings.tf_map_scanmatch_transform_frame_name.lstrip("/"), map_from_base, stamp_ns)
        if self._settings.pub_map_odom_transform:
            self._send_odometry_frame(map_from_base, stamp_ns)

    def _send_odometry_frame(self, map_from_base: Pose, stamp_ns: int) -> None:
        """Publish the odometry frame's transform; the odometry is the identity where nobody publishes it."""
        odom_from_base = Pose()
        if self._odom != self._base:
            try:
                odom_from_base = self._scans.buffer.lookup_transform(self._odom, self._base, stamp_ns).pose
            except TransformError as error:
                self._warnings.warn(f"the odometry is assumed to be at rest: {error}")
        self._send(self._odom, map_from_base @ odom_from_base.inverse(), stamp_ns)

    def _send(self, child: str, pose: Pose, stamp_ns: int) -> None:
        self._broadcaster.send_transform(
            Transform(
                parent=self._frame,
                child=child,
                stamp_ns=stamp_ns,
                translation=pose.position,
                rotation=pose.quaternion,
            )
        )

    async def _publish_maps(self) -> None:
        rate = Rate(self._node, 1.0 / self._settings.map_pub_period)
        while True:
            if self._is_changed:
                self._update_map()
            self._map["header"] = {"stamp": self._node.clock.now_ns(), "frame_id": self._frame}
            self._maps.publish(self._map)
            await rate.sleep()

    def _update_map(self) -> None:
        settings = self._settings
        length = settings.map_resolution * settings.map_size
        origin = {"x": -settings.map_start_x * length, "y": -settings.map_start_y * length}
        info = {
            "resolution": settings.map_resolution,
            "width": settings.map_size,
            "height": settings.map_size,
            "origin": {"position": origin, "orientation": {"w": 1.0}},
        }
        self._map = {"header": {"frame_id": self._frame}, "info": info, "data": self._slam.cells().reshape(-1)}
        self._is_changed = False

    def _get_map(self, _request: object) -> dict[str, Any]:
        return {"map": self._map}
