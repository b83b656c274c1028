"""laser_scan_matcher/laser_scan_matcher_node: the robot's pose from scan to scan."""

import asyncio
import math
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
from msgspec import Meta, Struct
from numpy.typing import NDArray

from trundle.gazebo.nodes import NodeHost
from trundle.gazebo.nodes.private_parameters import private_parameters
from trundle.gazebo.nodes.rate import LogThrottle
from trundle.robots.parameters import ParamError
from trundle.ros import Node, Transform, TransformBroadcaster, TransformError, to_nsec
from trundle.spatial import NS_PER_S, Pose

from ..pose_messages import from_planar, planar, pose_fields, read_pose
from ..scan_messages import beam_ends
from ..scan_queue import ScanQueue
from ..settings import read_settings
from ..transform_filter import TransformFilter
from . import _icp
from .tracker import ScanTracker

if TYPE_CHECKING:
    from trundle.ros.message_types import sensor_msgs

_QUEUE = 5
_Ratio = Annotated[float, Meta(ge=0.0, le=1.0)]
_Length = Annotated[float, Meta(ge=0.0, le=1000.0)]
_MAX_SPEED = 1e4
"""[m/s], [rad/s]"""


class MatcherSettings(Struct):
    """Lengths [m], angles [rad]."""

    base_frame: str = "base_link"
    fixed_frame: str = "world"
    kf_dist_linear: _Length = 0.10
    kf_dist_angular: _Length = math.radians(10.0)
    use_imu: bool = True
    use_odom: bool = True
    use_vel: bool = False
    stamped_vel: bool = False
    publish_tf: bool = True
    publish_pose: bool = True
    publish_pose_stamped: bool = False
    publish_pose_with_covariance: bool = False
    publish_pose_with_covariance_stamped: bool = False
    max_angular_correction_deg: Annotated[float, Meta(ge=0.0, le=180.0)] = 45.0
    """[°]"""
    max_linear_correction: _Length = 0.50
    max_iterations: Annotated[int, Meta(ge=1, le=1000)] = 10
    epsilon_xy: _Length = 0.000001
    epsilon_theta: _Length = 0.000001
    max_correspondence_dist: Annotated[float, Meta(ge=0.001, le=1000.0)] = 0.3
    sigma: _Length = 0.010
    use_point_to_line_distance: Annotated[int, Meta(ge=0, le=1)] = 1
    outliers_maxPerc: _Ratio = 0.90  # noqa: N815
    outliers_adaptive_order: _Ratio = 0.7
    outliers_adaptive_mult: _Length = 2.0
    do_compute_covariance: Annotated[int, Meta(ge=0, le=1)] = 0

    def icp_options(self) -> _icp.IcpOptions:
        """Return the options of the matches."""
        options = _icp.IcpOptions()
        options.max_iterations = self.max_iterations
        options.epsilon_xy, options.epsilon_theta = self.epsilon_xy, self.epsilon_theta
        options.max_correspondence, options.sigma = self.max_correspondence_dist, self.sigma
        options.max_linear = self.max_linear_correction
        options.max_angular = math.radians(self.max_angular_correction_deg)
        options.max_ratio, options.uses_lines = self.outliers_maxPerc, self.use_point_to_line_distance != 0
        options.adaptive_order, options.adaptive_multiple = self.outliers_adaptive_order, self.outliers_adaptive_mult
        return options


class LaserScanMatcher:
    """Publishes the transform of the robot, `pose2D` and other poses, from `scan`.

    Parameters, with the original's names and defaults: `MatcherSettings`, position_covariance and
    orientation_covariance. use_imu, use_odom and use_vel predict the motion between scans from `imu/data` (the
    heading), `odom` or `vel`, if these are published; the match is by points and lines. Scans wait for the
    transform of the laser; clouds are not read.
    """

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node
        self._odometry: tuple[Pose, Pose] | None = None
        """Pose of the odometry at the last scan, and now."""
        self._heading: tuple[float, float] | None = None
        """Heading of the imu at the last scan, and now [rad]."""
        self._velocity: tuple[float, float, float] = (0.0, 0.0, 0.0)
        self._last_ns: int | None = None

    async def run(self) -> int:
        """Match until cancelled."""
        node = self._node
        try:
            parameters = await private_parameters(node)
            settings = self._settings = read_settings(MatcherSettings, parameters)
            if parameters.flag("use_cloud_input", default=False):
                raise ParamError(f"parameter {parameters.namespace}/use_cloud_input: clouds are not read; use scans")
            default = (1e-9, 1e-9, 1e-9)
            position = parameters.numbers("position_covariance", 3, default)
            orientation = parameters.numbers("orientation_covariance", 3, default)
        except ParamError as error:
            node.log.fatal(str(error))
            return 1
        self._covariance = np.diag([position[0], position[1], orientation[2]])
        self._base = settings.base_frame.lstrip("/")
        self._fixed = settings.fixed_frame.lstrip("/")
        self._tracker = ScanTracker(
            settings.icp_options(), keyframe_linear=settings.kf_dist_linear, keyframe_angular=settings.kf_dist_angular
        )
        self._warnings = LogThrottle(node, 5.0)
        self._advertise(settings)
        queue = ScanQueue(node, self._match, size=_QUEUE)
        self._scans = TransformFilter(node, self._base, queue.add, queue_size=_QUEUE)
        node.subscribe("scan", "sensor_msgs/LaserScan", self._scans.add, queue_size=_QUEUE)
        self._subscribe(settings)
        async with asyncio.TaskGroup() as tasks:
            matching = tasks.create_task(queue.run())
            await node.closed.wait()
            matching.cancel()
        return 0

    def _advertise(self, settings: MatcherSettings) -> None:
        node = self._node
        kinds = {
            "pose2D": ("Pose2D", settings.publish_pose),
            "pose_stamped": ("PoseStamped", settings.publish_pose_stamped),
            "pose_with_covariance": ("PoseWithCovariance", settings.publish_pose_with_covariance),
            "pose_with_covariance_stamped": (
                "PoseWithCovarianceStamped",
                settings.publish_pose_with_covariance_stamped,
            ),
        }
        self._topics = {
            topic: node.advertise(topic, f"geometry_msgs/{kind}", queue_size=5)
            for topic, (kind, is_used) in kinds.items()
            if is_used
        }
        self._broadcaster = TransformBroadcaster(node) if settings.publish_tf else None

    def _subscribe(self, settings: MatcherSettings) -> None:
        node = self._node
        if settings.use_imu:
            node.subscribe("imu/data", "sensor_msgs/Imu", self._on_imu, queue_size=1)
        if settings.use_odom:
            node.subscribe("odom", "nav_msgs/Odometry", self._on_odometry, queue_size=1)
        if settings.use_vel:
            kind = "geometry_msgs/TwistStamped" if settings.stamped_vel else "geometry_msgs/Twist"
            node.subscribe("vel", kind, self._on_velocity, queue_size=1)

    # -- prediction of the motion

    def _on_imu(self, message: Any) -> None:
        q = message.orientation
        heading = math.atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z))
        if math.isfinite(heading):
            self._heading = (heading if self._heading is None else self._heading[0], heading)

    def _on_odometry(self, message: Any) -> None:
        try:
            pose = read_pose(message.pose.pose)
        except ValueError as error:
            self._warnings.warn(f"an odometry is ignored: {error}")
            return
        self._odometry = (pose if self._odometry is None else self._odometry[0], pose)

    def _on_velocity(self, message: Any) -> None:
        twist = getattr(message, "twist", message)
        velocity = (twist.linear.x, twist.linear.y, twist.angular.z)
        if all(abs(value) <= _MAX_SPEED for value in velocity):
            self._velocity = velocity

    def _predict(self, dt: float) -> Pose:
        """Return the motion since the last scan."""
        motion = Pose()
        if self._settings.use_vel:
            motion = from_planar(*(dt * value for value in self._velocity))
        if self._odometry is not None:
            then, now = self._odometry
            motion = from_planar(*planar(then.inverse() @ now))
            self._odometry = (now, now)
        if self._heading is not None:
            x, y, _ = motion.position
            motion = from_planar(x, y, math.remainder(self._heading[1] - self._heading[0], math.tau))
            self._heading = (self._heading[1], self._heading[1])
        return motion

    # -- scans

    async def _match(self, scan: "sensor_msgs.LaserScan") -> None:
        stamp_ns = to_nsec(scan.header.stamp)
        try:
            base_from_laser = self._scans.buffer.lookup_transform(self._base, scan.header.frame_id, stamp_ns).pose
            points = beam_ends(scan)
        except (TransformError, ValueError) as error:
            self._warnings.warn(f"a scan is skipped: {error}")
            return
        dt = 0.0 if self._last_ns is None else (stamp_ns - self._last_ns) / NS_PER_S
        self._last_ns = stamp_ns
        if not await asyncio.to_thread(self._tracker.add, points, base_from_laser, self._predict(dt)):
            self._warnings.warn("a scan matches nothing; the predicted motion is used")
        has_match = self._settings.do_compute_covariance and self._tracker.match is not None
        self._publish(stamp_ns, self._tracker.covariance if has_match else self._covariance)

    def _publish(self, stamp_ns: int, covariance: NDArray[np.float64]) -> None:
        x, y, yaw = self._tracker.pose
        full = np.zeros((6, 6))
        full[np.ix_((0, 1, 5), (0, 1, 5))] = covariance
        header = {"stamp": stamp_ns, "frame_id": self._fixed}
        pose = pose_fields(self._tracker.fixed_from_base)
        certain = {"pose": pose, "covariance": full.ravel().tolist()}
        messages: dict[str, dict[str, Any]] = {
            "pose2D": {"x": x, "y": y, "theta": yaw},
            "pose_stamped": {"header": header, "pose": pose},
            "pose_with_covariance": certain,
            "pose_with_covariance_stamped": {"header": header, "pose": certain},
        }
        for topic, publisher in self._topics.items():
            publisher.publish(messages[topic])
        if self._broadcaster is not None:
            self._broadcaster.send_transform(
                Transform(
                    parent=self._fixed,
                    child=self._base,
                    stamp_ns=stamp_ns,
                    translation=self._tracker.fixed_from_base.position,
                    rotation=self._tracker.fixed_from_base.quaternion,
                )
            )
