"""amcl: localizes the robot in a known map with a particle filter."""

import math
from typing import TYPE_CHECKING, Any

from msgspec import structs

from trundle.gazebo.nodes import NodeHost
from trundle.gazebo.nodes.private_parameters import private_parameters
from trundle.gazebo.nodes.rate import LogThrottle
from trundle.robots.parameters import ParamError, RosParameters
from trundle.ros import (
    Node,
    Options,
    ReconfigureServer,
    ServiceError,
    Transform,
    TransformBroadcaster,
    TransformError,
    to_nsec,
)
from trundle.spatial import NS_PER_S, Pose

from ..occupancy_messages import read_cells
from ..pose_messages import PlanarPose, from_planar, planar, pose_fields, read_pose
from ..transform_filter import TransformFilter
from . import _localization
from .amcl_settings import read_settings, reconfigure_options, settings_from
from .laser_scan import ScanReader
from .spread_warning import SpreadWarning

if TYPE_CHECKING:
    from trundle.ros.message_types import geometry_msgs, nav_msgs, sensor_msgs

_SEED = 1
_QUEUE = 100
_RETRY_S = 0.5
_SCAN_TIMEOUT_NS = 15 * NS_PER_S
_INITIAL_COVARIANCE = {"initial_cov_xx": 0.25, "initial_cov_yy": 0.25, "initial_cov_aa": (math.pi / 12.0) ** 2}


class Amcl:
    """Publishes `amcl_pose`, `particlecloud` and the transform of the odometry frame from `scan`, tf and the map.

    Parameters, with the original's names and defaults: `AmclSettings`, initial_pose_x, _y, _a, initial_cov_xx, _yy,
    _aa, std_warn_level_x, _y, _yaw. Services global_localization, request_nomotion_update and set_map. Random numbers
    have a fixed seed. The pose is the mean of the heaviest cluster by the weights of the last scan, before resampling,
    aligned with the scan; motion between the stamp of an initial pose and the first scan is added to it.
    """

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del host
        self._node = node
        self._arguments = arguments
        self._filter: _localization.ParticleFilter | None = None
        self._initial: tuple[PlanarPose, tuple[float, ...], int] | None = None
        """An initial pose that is not applied yet: pose, covariance of x, y, yaw, stamp [ns]."""
        self._odom_from_base: PlanarPose | None = None
        """Odometry at the particles' last move; None: the particles were spread after the last scan."""
        self._map_from_odom: Pose | None = None
        self._updates = 0
        self._is_forced = False
        self._has_map = False
        self._last_scan_ns = self._last_save_ns = 0

    async def run(self) -> int:
        """Localize until cancelled."""
        node = self._node
        if self._arguments:
            node.log.error(f"usage: amcl; got {' '.join(self._arguments)!r}; bags are played by trundle bag play")
            return 1
        try:
            parameters = await private_parameters(node)
            self._settings = self._defaults = read_settings(parameters, node.log.warn)
            self._read_initial_pose(parameters)
            self._spread_warning = SpreadWarning(node, parameters)
        except ParamError as error:
            node.log.fatal(str(error))
            return 1
        self._warnings = LogThrottle(node, 5.0)
        kind = "geometry_msgs/PoseWithCovarianceStamped"
        self._poses = node.advertise("amcl_pose", kind, latch=True, queue_size=2)
        self._clouds = node.advertise(
            "particlecloud",
            "geometry_msgs/PoseArray",
            latch=True,
            queue_size=2,
            on_connect=lambda _: self._show_cloud(),
        )
        self._broadcaster = TransformBroadcaster(node)
        self._scans = TransformFilter(node, self._settings.odom_frame_id, self._on_scan, queue_size=_QUEUE)
        node.advertise_service("global_localization", "std_srvs/Empty", self._spread_over_map)
        node.advertise_service("request_nomotion_update", "std_srvs/Empty", self._force_update)
        node.advertise_service("set_map", "nav_msgs/SetMap", self._set_map)
        node.subscribe("scan", "sensor_msgs/LaserScan", self._scans.add, queue_size=_QUEUE)
        node.subscribe("initialpose", kind, self._on_initial_pose, queue_size=2)
        ReconfigureServer(node, reconfigure_options(self._settings), self._reconfigure)
        if self._settings.use_map_topic:
            node.subscribe("map", "nav_msgs/OccupancyGrid", self._on_map, queue_size=1)
        else:
            await self._request_map()
        while not node.closed.is_set():
            await node.clock.sleep(_SCAN_TIMEOUT_NS / NS_PER_S)
            self._check_scans()
        return 0

    # -- the map

    async def _request_map(self) -> None:
        self._node.log.info("Requesting the map...")
        while True:
            try:
                await self._node.wait_for_service("static_map", None)
                answer: Any = await self._node.call_service("static_map", "nav_msgs/GetMap", {})
            except ServiceError as error:
                self._warnings.warn(f"no map yet: {error}; trying again")
                await self._node.clock.sleep(_RETRY_S)
            else:
                self._use_map(answer.map)
                return

    def _on_map(self, message: "nav_msgs.OccupancyGrid") -> None:
        if not (self._settings.first_map_only and self._has_map):
            self._use_map(message)

    def _set_map(self, request: "nav_msgs.SetMapRequest") -> dict[str, Any]:
        is_used = self._use_map(request.map)
        self._on_initial_pose(request.initial_pose)
        self._is_forced |= self._settings.force_update_after_set_map
        return {"success": is_used}

    def _use_map(self, message: "nav_msgs.OccupancyGrid") -> bool:
        info = message.info
        try:
            cells = read_cells(message)
            origin = read_pose(info.origin)
            self._map = _localization.OccupancyMap(
                cells, resolution=info.resolution, x=origin.position[0], y=origin.position[1]
            )
        except ValueError as error:
            self._node.log.error(f"a map is ignored: {error}")
            return False
        self._node.log.info(f"Received a {info.width} X {info.height} map @ {info.resolution:.3f} m/pix")
        if message.header.frame_id.lstrip("/") != self._settings.global_frame_id:
            self._node.log.warn(
                f"the map's frame {message.header.frame_id!r} is not global_frame_id {self._settings.global_frame_id!r}"
            )
        if abs(origin.rpy[2]) > 1e-6:
            self._node.log.warn("the map's origin is rotated, which amcl ignores")
        self._has_map = True
        self._start_filter()
        return True

    def _start_filter(self) -> None:
        """Restart the filter at the initial pose, with models of the current settings."""
        self._filter = _localization.ParticleFilter(self._settings.filter_options, self._map, seed=_SEED)
        self._make_models()
        if self._initial is None:
            self._initial = (self._initial_pose, self._initial_covariance, 0)
        self._odom_from_base = None

    def _make_models(self) -> None:
        self._odometry: _localization.OdometryModel = self._settings.odometry_model
        self._laser = _localization.LaserModel(self._settings.laser_options, self._map)
        self._reader = ScanReader(self._scans.buffer, self._settings)

    # -- where the robot may be

    def _read_initial_pose(self, parameters: RosParameters) -> None:
        values: list[float] = []
        for name, default in {**dict.fromkeys(_POSE_NAMES, 0.0), **_INITIAL_COVARIANCE}.items():
            try:
                values.append(parameters.number(name, default))
            except ParamError as error:
                self._node.log.warn(f"{error}; {default:g} is used")
                values.append(default)
        x, y, yaw, xx, yy, aa = values
        self._initial_pose: PlanarPose = (x, y, yaw)
        self._initial_covariance = (xx, 0.0, 0.0, 0.0, yy, 0.0, 0.0, 0.0, aa)

    def _on_initial_pose(self, message: "geometry_msgs.PoseWithCovarianceStamped") -> None:
        frame = message.header.frame_id.lstrip("/")
        if not frame:
            self._node.log.warn("the initial pose has an empty frame_id; set it")
        elif frame != self._settings.global_frame_id:
            self._node.log.warn(
                f"an initial pose in frame {frame!r} is ignored; it must be in {self._settings.global_frame_id!r}"
            )
            return
        covariance = [float(value) for value in message.pose.covariance]
        try:
            pose = planar(read_pose(message.pose.pose))
            if not all(math.isfinite(value) for value in covariance):
                raise ValueError("its covariance is not finite")
        except ValueError as error:
            self._node.log.warn(f"an initial pose is ignored: {error}")
            return
        self._node.log.info(f"Setting pose: {pose[0]:.3f} {pose[1]:.3f} {pose[2]:.3f}")
        xx, xy, yx, yy = (covariance[index] for index in (0, 1, 6, 7))
        self._initial = (pose, (xx, xy, 0.0, yx, yy, 0.0, 0.0, 0.0, covariance[35]), to_nsec(message.header.stamp))
        self._odom_from_base = None
        self._is_forced |= self._settings.force_update_after_initialpose

    def _spread_over_map(self, _request: object) -> dict[str, Any]:
        if self._filter is not None:
            self._node.log.info("Initializing with uniform distribution")
            self._filter.spread_over_map()
            self._initial = self._odom_from_base = None
        return {}

    def _apply_initial(self, particles: _localization.ParticleFilter, odom_from_base: PlanarPose) -> None:
        """Spread the particles about the initial pose, moved by the odometry since its stamp."""
        if self._initial is None:
            return
        pose, covariance, stamp_ns = self._initial
        self._initial = None
        map_from_base = from_planar(*pose)
        if stamp_ns:
            try:
                then = self._scans.buffer.lookup_transform(
                    self._settings.odom_frame_id, self._settings.base_frame_id, stamp_ns
                ).pose
            except TransformError:
                pass  # the stamp is of another clock, or before the first odometry
            else:
                map_from_base = map_from_base @ from_planar(*planar(then)).inverse() @ from_planar(*odom_from_base)
        particles.spread(planar(map_from_base), covariance)

    # -- scans

    def _force_update(self, _request: object) -> dict[str, Any]:
        self._is_forced = True
        return {}

    def _on_scan(self, scan: "sensor_msgs.LaserScan") -> None:
        settings, stamp_ns = self._settings, to_nsec(scan.header.stamp)
        self._last_scan_ns = self._node.clock.now_ns()
        if self._filter is None:
            return
        try:
            pose = self._scans.buffer.lookup_transform(settings.odom_frame_id, settings.base_frame_id, stamp_ns).pose
        except TransformError as error:
            self._warnings.warn(f"a scan is skipped: no pose of the robot: {error}")
            return
        odom_from_base = planar(pose)
        is_first = self._odom_from_base is None
        if is_first:
            self._apply_initial(self._filter, odom_from_base)
            self._updates = 0
        if is_first or self._is_forced or self._has_moved(odom_from_base):
            self._update(scan, stamp_ns, odom_from_base, pose, is_first=is_first)
        else:
            self._save_pose(pose)
        self._broadcast(stamp_ns)

    def _has_moved(self, pose: PlanarPose) -> bool:
        last = self._odom_from_base
        assert last is not None
        turned = math.remainder(pose[2] - last[2], math.tau)
        settings = self._settings
        return max(abs(pose[0] - last[0]), abs(pose[1] - last[1])) > settings.update_min_d or (
            abs(turned) > settings.update_min_a
        )

    def _update(
        self, scan: "sensor_msgs.LaserScan", stamp_ns: int, odom: PlanarPose, odom_pose: Pose, *, is_first: bool
    ) -> None:
        particles = self._filter
        assert particles is not None
        self._is_forced = False
        beams = self._reader.read(scan)
        if beams is None:
            self._warnings.warn(f"a scan is skipped: {self._reader.fault}")
            return
        if self._odom_from_base is not None:
            particles.move(self._odometry, self._odom_from_base, odom)
        self._odom_from_base = odom
        laser = {"range_max": beams.range_max_m, "x": beams.x, "y": beams.y}
        particles.weigh(self._laser, beams.ranges, beams.bearings, **laser)
        self._updates += 1
        is_resampled = self._updates % max(self._settings.resample_interval, 1) == 0
        estimate = particles.estimate() if is_resampled or is_first else None
        if is_resampled:
            particles.resample()
        self._publish_cloud(particles)
        if estimate is not None:
            mean, covariance = estimate
            found = self._laser.align(mean, beams.ranges, beams.bearings, **laser)
            self._publish_pose(found, covariance, stamp_ns, odom_pose)

    def _publish_pose(self, pose: PlanarPose, covariance: tuple[float, ...], stamp_ns: int, odom_pose: Pose) -> None:
        map_from_base = from_planar(*pose)
        self._map_from_odom = map_from_base @ odom_pose.inverse()
        full = [0.0] * 36
        full[0], full[1], full[6], full[7], full[35] = (covariance[index] for index in (0, 1, 3, 4, 8))
        self._covariance = (full[0], full[7], full[35])
        header = {"stamp": stamp_ns, "frame_id": self._settings.global_frame_id}
        self._poses.publish({"header": header, "pose": {"pose": pose_fields(map_from_base), "covariance": full}})
        self._spread_warning.publish(self._covariance)

    def _show_cloud(self) -> None:
        """Show a new subscriber where the particles are now: the latched cloud is that of the last subscriber."""
        if self._filter is not None and self._odom_from_base is not None:
            self._publish_cloud(self._filter)

    def _publish_cloud(self, particles: _localization.ParticleFilter) -> None:
        if self._clouds.has_subscribers:
            poses = [pose_fields(from_planar(x, y, yaw)) for x, y, yaw, _ in particles.particles().tolist()]
            header = {"stamp": self._node.clock.now_ns(), "frame_id": self._settings.global_frame_id}
            self._clouds.publish({"header": header, "poses": poses})

    def _broadcast(self, stamp_ns: int) -> None:
        if self._map_from_odom is None or not self._settings.tf_broadcast:
            return
        self._broadcaster.send_transform(
            Transform(
                parent=self._settings.global_frame_id,
                child=self._settings.odom_frame_id,
                stamp_ns=stamp_ns + round(self._settings.transform_tolerance * NS_PER_S),
                translation=self._map_from_odom.position,
                rotation=self._map_from_odom.quaternion,
            )
        )

    def _save_pose(self, odom_pose: Pose) -> None:
        """Write the pose to the parameters, for the next start."""
        now_ns, rate_hz = self._node.clock.now_ns(), self._settings.save_pose_rate
        if self._map_from_odom is None or rate_hz <= 0.0 or now_ns - self._last_save_ns < NS_PER_S / rate_hz:
            return
        self._last_save_ns = now_ns
        pose = planar(self._map_from_odom @ odom_pose)
        names = (*_POSE_NAMES, *_INITIAL_COVARIANCE)
        self._node.loop.spawn(self._write(dict(zip(names, (*pose, *self._covariance), strict=True))))

    async def _write(self, values: dict[str, float]) -> None:
        for name, value in values.items():
            await self._node.params.set(f"~{name}", value)

    def _check_scans(self) -> None:
        silent_ns = self._node.clock.now_ns() - self._last_scan_ns
        if silent_ns > _SCAN_TIMEOUT_NS:
            topic = self._node.resolve("scan")
            self._node.log.warn(f"no laser scan for {silent_ns / NS_PER_S:.1f} s; is anything published on {topic}?")

    # -- dynamic_reconfigure

    def _reconfigure(self, values: Options) -> Options:
        if values.pop("restore_defaults"):
            values = structs.asdict(self._defaults)
        old = self._settings
        self._settings = settings_from({**structs.asdict(old), **values}, self._node.log.warn)
        self._scans.target = self._settings.odom_frame_id
        if self._filter is not None and self._settings != old:
            self._filter.set_options(self._settings.filter_options)
            self._make_models()
        return {option.name: option.value for option in reconfigure_options(self._settings)}


_POSE_NAMES = ("initial_pose_x", "initial_pose_y", "initial_pose_a")
