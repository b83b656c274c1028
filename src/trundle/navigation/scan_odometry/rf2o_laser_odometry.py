"""rf2o_laser_odometry/rf2o_laser_odometry_node: odometry from scans."""

import asyncio
import math
from typing import TYPE_CHECKING, Any

from trundle.gazebo.nodes import NodeHost
from trundle.gazebo.nodes.private_parameters import private_parameters
from trundle.gazebo.nodes.rate import LogThrottle
from trundle.robots.parameters import ParamError
from trundle.ros import Node, Transform, TransformBroadcaster, TransformError, to_nsec
from trundle.spatial import NS_PER_S, Pose

from ..pose_messages import from_planar, planar, pose_fields, read_pose
from ..scan_messages import beam_ends
from ..scan_queue import ScanQueue
from ..transform_filter import TransformFilter
from . import _icp
from .tracker import ScanTracker

if TYPE_CHECKING:
    from trundle.ros.message_types import sensor_msgs

_QUEUE = 5
_KEYFRAME_M, _KEYFRAME_RAD = 0.1, math.radians(10.0)


class Rf2oLaserOdometry:
    """Publishes odometry and the transform of the robot from scans.

    Parameters, with the original's names and defaults: laser_scan_topic /laser_scan, odom_topic /odom_rf2o,
    base_frame_id /base_link, odom_frame_id /odom, publish_tf true, init_pose_from_topic /base_pose_ground_truth (empty:
    begin at the origin at once). Scans are matched by points and lines, not by range flow, and each is used: freq and
    verbose change nothing. Messages have the scans' stamps.
    """

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node
        self._last: tuple[int, Pose] | None = None
        """Stamp [ns] and pose of the last scan."""
        self._motion = (0.0, 0.0, 0.0)
        """Velocity of the robot [m/s], [rad/s]."""

    async def run(self) -> int:
        """Match until cancelled."""
        node = self._node
        try:
            parameters = await private_parameters(node)
            self._base = parameters.text("base_frame_id", "/base_link").lstrip("/")
            self._odom = parameters.text("odom_frame_id", "/odom").lstrip("/")
            scan_topic = parameters.text("laser_scan_topic", "/laser_scan")
            odom_topic = parameters.text("odom_topic", "/odom_rf2o")
            start_topic = parameters.text("init_pose_from_topic", "/base_pose_ground_truth")
            has_tf = parameters.flag("publish_tf", default=True)
        except ParamError as error:
            node.log.fatal(str(error))
            return 1
        self._tracker = ScanTracker(_icp.IcpOptions(), keyframe_linear=_KEYFRAME_M, keyframe_angular=_KEYFRAME_RAD)
        self._has_start = not start_topic
        self._warnings = LogThrottle(node, 5.0)
        topic = odom_topic if odom_topic.startswith("/") else f"~{odom_topic}"
        self._topic = node.advertise(topic, "nav_msgs/Odometry", queue_size=5)
        self._broadcaster = TransformBroadcaster(node) if has_tf else None
        queue = ScanQueue(node, self._match, size=_QUEUE)
        self._scans = TransformFilter(node, self._base, queue.add, queue_size=_QUEUE)
        node.subscribe(scan_topic, "sensor_msgs/LaserScan", self._on_scan, queue_size=_QUEUE)
        if start_topic:
            node.subscribe(start_topic, "nav_msgs/Odometry", self._on_start, queue_size=1)
        async with asyncio.TaskGroup() as tasks:
            matching = tasks.create_task(queue.run())
            await node.closed.wait()
            matching.cancel()
        return 0

    def _on_start(self, message: Any) -> None:
        if self._has_start:
            return
        try:
            self._tracker.reset(from_planar(*planar(read_pose(message.pose.pose))))
        except ValueError as error:
            self._warnings.warn(f"the initial pose is ignored: {error}")
            return
        self._has_start = True

    def _on_scan(self, scan: "sensor_msgs.LaserScan") -> None:
        if self._has_start:
            self._scans.add(scan)
        else:
            self._warnings.warn("scans wait for a pose on init_pose_from_topic; set it empty to begin at the origin")

    async def _match(self, scan: "sensor_msgs.LaserScan") -> None:
        stamp_ns = to_nsec(scan.header.stamp)
        try:
            base_from_laser = self._scans.buffer.lookup_transform(self._base, scan.header.frame_id, stamp_ns).pose
            points = beam_ends(scan)
        except (TransformError, ValueError) as error:
            self._warnings.warn(f"a scan is skipped: {error}")
            return
        last = self._last
        dt = 0.0 if last is None else (stamp_ns - last[0]) / NS_PER_S
        predicted = from_planar(*(value * dt for value in self._motion))
        if not await asyncio.to_thread(self._tracker.add, points, base_from_laser, predicted):
            self._warnings.warn("a scan matches nothing; the robot's last velocity is used")
        pose = self._tracker.fixed_from_base
        if last is not None and dt > 0.0:
            x, y, yaw = planar(last[1].inverse() @ pose)
            self._motion = (x / dt, y / dt, yaw / dt)
        self._last = (stamp_ns, pose)
        self._publish(stamp_ns, pose)

    def _publish(self, stamp_ns: int, pose: Pose) -> None:
        x, y, turn = self._motion
        self._topic.publish(
            {
                "header": {"stamp": stamp_ns, "frame_id": self._odom},
                "child_frame_id": self._base,
                "pose": {"pose": pose_fields(pose)},
                "twist": {"twist": {"linear": {"x": x, "y": y}, "angular": {"z": turn}}},
            }
        )
        if self._broadcaster is not None:
            transform = Transform(
                parent=self._odom,
                child=self._base,
                stamp_ns=stamp_ns,
                translation=pose.position,
                rotation=pose.quaternion,
            )
            self._broadcaster.send_transform(transform)
