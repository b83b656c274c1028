"""robot_localization/navsat_transform_node: satellite fixes as odometry in the robot's world frame."""

import math
from typing import Any

import numpy as np

from trundle.robots.parameters import ParamError, RosParameters
from trundle.ros import (
    Node,
    ServiceError,
    StaticTransformBroadcaster,
    Transform,
    TransformError,
    TransformListener,
    to_nsec,
)
from trundle.spatial import Pose, Quaternion, matrix_from_quaternion, quaternion_from_rpy

from ..host import NodeHost
from ..private_parameters import private_parameters
from ..rate import LogThrottle, Rate
from .geodesy import TangentPlane, UtmZone, from_utm, parse_zone, to_utm, zone_of

_NO_FIX = -1
_SIZE = 6
_OLD_NAMES = {
    "broadcast_utm_transform": "broadcast_cartesian_transform",
    "broadcast_utm_transform_as_parent_frame": "broadcast_cartesian_transform_as_parent_frame",
}


class NavsatTransform:
    """Publishes `odometry/gps` from `gps/fix`, `imu/data` and `odometry/filtered`.

    Parameters, with the original's defaults: frequency 10, delay 0, magnetic_declination_radians 0, yaw_offset 0,
    zero_altitude false, publish_filtered_gps false (`gps/filtered`), use_odometry_yaw false, wait_for_datum false,
    datum [latitude, longitude, yaw], broadcast_cartesian_transform false and ..._as_parent_frame false,
    use_local_cartesian false, cartesian_frame_id utm or local_enu. Services `datum`, `toLL`, `fromLL`, `setUTMZone`.
    The grid is UTM, or the plane that touches the earth at the first fix.
    """

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node
        self._zone: UtmZone | None = None
        self._plane: TangentPlane | None = None
        self._convergence = 0.0
        self._grid_from_first: Pose | None = None
        """Place of the first fix, or of the datum; None: none yet."""
        self._world_from_robot: Pose | None = None
        """Pose of the robot by the odometry."""
        self._start: Pose | None = None
        """The same, when the transform is made."""
        self._orientation: Quaternion | None = None
        """Of the robot, east is 0."""
        self._world_from_grid: Pose | None = None
        self._fix: tuple[int, Pose, np.ndarray] | None = None
        """Stamp [ns], place in the grid and covariance (3, 3) of a fix that is not published yet."""
        self._odometry: Any = None
        self._gps_frame = ""
        self._base, self._world = "base_link", "odom"

    async def run(self) -> int:
        """Transform until cancelled."""
        node = self._node
        try:
            settings = (await private_parameters(node)).renamed(_OLD_NAMES)
            rate_hz = settings.number("frequency", 10.0, above=0.0)
            delay_s = settings.number("delay", 0.0, minimum=0.0)
            self._read(settings)
            datum = self._datum(settings)
        except ParamError as error:
            node.log.fatal(str(error))
            return 1
        self._warnings = LogThrottle(node, 5.0)
        self._buffer = TransformListener(node).buffer
        self._broadcaster = StaticTransformBroadcaster(node)
        self._offer()
        if datum is not None:
            self._set_datum(*datum)
        await node.clock.sleep(delay_s)
        rate = Rate(node, rate_hz)
        while not node.closed.is_set():
            await rate.sleep()
            self._step()
        return 0

    def _read(self, settings: RosParameters) -> None:
        self._heading = settings.number("magnetic_declination_radians", 0.0) + settings.number("yaw_offset", 0.0)
        self._is_flat = settings.flag("zero_altitude", default=False)
        self._publishes_fixes = settings.flag("publish_filtered_gps", default=False)
        self._uses_odometry_yaw = settings.flag("use_odometry_yaw", default=False)
        self._has_datum = settings.flag("wait_for_datum", default=False)
        self._is_local = settings.flag("use_local_cartesian", default=False)
        self._is_broadcast = settings.flag("broadcast_cartesian_transform", default=False)
        self._is_parent = settings.flag("broadcast_cartesian_transform_as_parent_frame", default=False)
        self._grid = settings.text("cartesian_frame_id", "local_enu" if self._is_local else "utm").lstrip("/")

    def _datum(self, settings: RosParameters) -> tuple[float, float, float, Quaternion] | None:
        """Return latitude, longitude [°], altitude [m] and orientation of the parameter; None: there is none."""
        values = settings.items("datum")
        if not self._has_datum or not values:
            return None
        if len(values) > 3:
            self._node.log.warn("parameter datum: only latitude, longitude and yaw are used")
        latitude, longitude, yaw = RosParameters({"datum": values[:3]}, settings.namespace).numbers("datum", 3)
        return latitude, longitude, 0.0, quaternion_from_rpy(0.0, 0.0, yaw)

    def _offer(self) -> None:
        node, package = self._node, "robot_localization"
        self._odometries = node.advertise("odometry/gps", "nav_msgs/Odometry", queue_size=10)
        self._fixes = node.advertise("gps/filtered", "sensor_msgs/NavSatFix", queue_size=10)
        node.advertise_service("datum", f"{package}/SetDatum", self._on_datum)
        node.advertise_service("toLL", f"{package}/ToLL", self._on_to_ll)
        node.advertise_service("fromLL", f"{package}/FromLL", self._on_from_ll)
        node.advertise_service("setUTMZone", f"{package}/SetUTMZone", self._on_zone)
        node.subscribe("odometry/filtered", "nav_msgs/Odometry", self._on_odometry, queue_size=1)
        node.subscribe("gps/fix", "sensor_msgs/NavSatFix", self._on_fix, queue_size=1)
        if not self._uses_odometry_yaw and not self._has_datum:
            node.subscribe("imu/data", "sensor_msgs/Imu", self._on_imu, queue_size=1)

    # -- messages

    def _on_odometry(self, message: Any) -> None:
        self._world = message.header.frame_id.lstrip("/") or self._world
        self._base = message.child_frame_id.lstrip("/") or self._base
        pose = _finite_pose(message.pose.pose)
        if pose is None:
            self._warnings.warn("an odometry is left out: its pose is not finite, or has an orientation of zeros")
            return
        self._world_from_robot, self._odometry = pose, message
        if self._world_from_grid is None and not self._has_datum:
            self._start = pose
            if self._uses_odometry_yaw:
                self._orientation = pose.quaternion

    def _on_imu(self, message: Any) -> None:
        if self._world_from_grid is not None or self._has_datum:
            return
        q = message.orientation
        norm = math.hypot(q.w, q.x, q.y, q.z)
        if message.orientation_covariance[0] < 0.0 or not 0.0 < norm < math.inf:
            self._warnings.warn("an imu is left out: it has no orientation")
            return
        world_from_imu = Pose((0.0, 0.0, 0.0), (q.w / norm, q.x / norm, q.y / norm, q.z / norm))
        base_from_imu = self._find(self._base, message.header.frame_id)
        if base_from_imu is not None:
            imu_from_base = Pose((0.0, 0.0, 0.0), base_from_imu.quaternion).inverse()
            self._orientation = (world_from_imu @ imu_from_base).quaternion

    def _on_fix(self, message: Any) -> None:
        self._gps_frame = message.header.frame_id.lstrip("/")
        values = (message.latitude, message.longitude, message.altitude)
        if message.status.status == _NO_FIX or not all(map(math.isfinite, values)):
            self._warnings.warn("a fix is left out: it has no status of a fix, or is not finite")
            return
        try:
            if self._grid_from_first is None and not self._has_datum:
                self._grid_from_first = self._begin(*values)
            if self._grid_from_first is None:
                return
            place = self._project(*values)
        except ValueError as error:
            self._warnings.warn(f"a fix is left out: {error}")
            return
        covariance = np.array(message.position_covariance, dtype=np.float64).reshape(3, 3)
        self._fix = (to_nsec(message.header.stamp), place, covariance)

    # -- the transform

    def _begin(self, latitude: float, longitude: float, altitude_m: float) -> Pose:
        """Choose the grid of a place, and return where it is in there."""
        if self._is_local:
            self._plane = TangentPlane(latitude, longitude, altitude_m)
            self._convergence = 0.0
        else:
            self._zone = self._zone or zone_of(latitude, longitude)
            self._convergence = to_utm(latitude, longitude, self._zone).convergence
        return self._project(latitude, longitude, altitude_m)

    def _project(self, latitude: float, longitude: float, altitude_m: float) -> Pose:
        if not abs(latitude) <= 90.0:
            raise ValueError(f"latitude {latitude:g} is beyond 90°")
        if self._plane is not None:
            return Pose(self._plane.forward(latitude, longitude, altitude_m))
        assert self._zone is not None, "the first place chose it"
        place = to_utm(latitude, longitude, self._zone)
        return Pose((place.easting_m, place.northing_m, altitude_m))

    def _geographic(self, grid_from_point: Pose) -> tuple[float, float, float]:
        x, y, z = grid_from_point.position
        if self._plane is not None:
            latitude, longitude, _ = self._plane.reverse(x, y, 0.0)
            return latitude, longitude, z
        assert self._zone is not None, "the first place chose it"
        return (*from_utm(x, y, self._zone), z)

    def _step(self) -> None:
        if self._world_from_grid is None:
            self._compute()
            return
        if self._fix is not None:
            self._publish_odometry(*self._fix)
            self._fix = None
        if self._publishes_fixes and self._odometry is not None:
            self._publish_fix()
            self._odometry = None

    def _compute(self) -> None:
        """Compute the transform once the first fix, the odometry and the orientation are known."""
        if self._grid_from_first is None or self._start is None or self._orientation is None:
            return
        roll, pitch, yaw = Pose((0.0, 0.0, 0.0), self._orientation).rpy
        yaw += self._heading + self._convergence
        place = self._grid_from_first
        offset = None if self._has_datum else self._find(self._base, self._gps_frame)
        if offset is not None:
            turned = Pose((0.0, 0.0, 0.0), quaternion_from_rpy(roll, pitch, yaw)).transform_vector(offset.position)
            place = Pose(_minus(place.position, turned))
        grid_from_robot = Pose(place.position, quaternion_from_rpy(0.0, 0.0, yaw))
        start = Pose(self._start.position, quaternion_from_rpy(0.0, 0.0, self._start.rpy[2]))
        self._world_from_grid = start @ grid_from_robot.inverse()
        self._node.log.info(f"the transform to {self._grid} is known; the robot's heading in it is {yaw:.4f} rad")
        if self._is_broadcast:
            self._broadcast(self._world_from_grid)

    def _broadcast(self, world_from_grid: Pose) -> None:
        parent, child, pose = self._world, self._grid, world_from_grid
        if self._is_parent:
            parent, child, pose = child, parent, pose.inverse()
        x, y, z = pose.position
        self._broadcaster.send_transform(
            Transform(
                parent=parent,
                child=child,
                stamp_ns=self._node.clock.now_ns(),
                translation=(x, y, 0.0 if self._is_flat else z),
                rotation=pose.quaternion,
            )
        )

    def _find(self, target: str, source: str) -> Pose | None:
        """Return the latest `target_from_source`; the frames' own origin where one has no name."""
        source = source.lstrip("/")
        if source in ("", target):
            return Pose()
        try:
            return self._buffer.lookup_transform(target, source, 0).pose
        except TransformError as error:
            self._warnings.warn(f"the offset of {source} is not known: {error}")
            return None

    # -- what comes of it

    def _publish_odometry(self, stamp_ns: int, place: Pose, covariance: np.ndarray) -> None:
        assert self._world_from_grid is not None, "it was computed"
        world_from_gps = Pose((self._world_from_grid @ place).position)
        position = world_from_gps.position
        offset = self._find(self._base, self._gps_frame)
        if offset is not None and self._world_from_robot is not None:
            position = _minus(position, self._world_from_robot.transform_vector(offset.position))
        x, y, z = position
        turn = matrix_from_quaternion(self._world_from_grid.quaternion)
        full = np.zeros((_SIZE, _SIZE))
        full[:3, :3] = turn @ covariance @ turn.T
        pose = {"position": {"x": x, "y": y, "z": 0.0 if self._is_flat else z}, "orientation": {"w": 1.0}}
        header = {"stamp": stamp_ns, "frame_id": self._world}
        self._odometries.publish({"header": header, "pose": {"pose": pose, "covariance": full.ravel().tolist()}})

    def _publish_fix(self) -> None:
        assert self._world_from_grid is not None, "it was computed"
        assert self._world_from_robot is not None, "there was an odometry"
        latitude, longitude, altitude_m = self._geographic(self._world_from_grid.inverse() @ self._world_from_robot)
        turn = matrix_from_quaternion(self._world_from_grid.inverse().quaternion)
        covariance = np.array(self._odometry.pose.covariance, dtype=np.float64).reshape(_SIZE, _SIZE)[:3, :3]
        self._fixes.publish(
            {
                "header": {"stamp": self._odometry.header.stamp, "frame_id": self._base},
                "latitude": latitude,
                "longitude": longitude,
                "altitude": 0.0 if self._is_flat else altitude_m,
                "position_covariance": (turn @ covariance @ turn.T).ravel().tolist(),
                "position_covariance_type": 3,
            }
        )

    # -- services

    def _set_datum(self, latitude: float, longitude: float, altitude_m: float, orientation: Quaternion) -> None:
        """Make a place the world's origin.

        Raises:
            ValueError: UTM does not reach there.
        """
        self._zone = None
        self._grid_from_first = self._begin(latitude, longitude, altitude_m)
        self._has_datum = True
        self._start, self._orientation, self._world_from_grid = Pose(), orientation, None
        self._compute()

    def _on_datum(self, request: Any) -> dict[str, Any]:
        place, q = request.geo_pose.position, request.geo_pose.orientation
        norm = math.hypot(q.w, q.x, q.y, q.z)
        if not 0.0 < norm < math.inf or not math.isfinite(place.latitude + place.longitude + place.altitude):
            raise ServiceError("the datum is not finite, or has an orientation of zeros")
        orientation = (q.w / norm, q.x / norm, q.y / norm, q.z / norm)
        try:
            self._set_datum(place.latitude, place.longitude, place.altitude, orientation)
        except ValueError as error:
            raise ServiceError(f"the datum is not used: {error}") from None
        return {}

    def _known(self) -> Pose:
        if self._world_from_grid is None:
            raise ServiceError("no transform yet: it needs a fix, an odometry and an orientation, or a datum")
        return self._world_from_grid

    def _on_to_ll(self, request: Any) -> dict[str, Any]:
        point = request.map_point
        grid_from_point = self._known().inverse() @ Pose((point.x, point.y, point.z))
        latitude, longitude, altitude_m = self._geographic(grid_from_point)
        return {"ll_point": {"latitude": latitude, "longitude": longitude, "altitude": altitude_m}}

    def _on_from_ll(self, request: Any) -> dict[str, Any]:
        place = request.ll_point
        world_from_grid = self._known()
        try:
            x, y, z = (world_from_grid @ self._project(place.latitude, place.longitude, place.altitude)).position
        except ValueError as error:
            raise ServiceError(str(error)) from None
        return {"map_point": {"x": x, "y": y, "z": 0.0 if self._is_flat else z}}

    def _on_zone(self, request: Any) -> dict[str, Any]:
        try:
            self._zone = parse_zone(request.utm_zone)
        except ValueError as error:
            raise ServiceError(str(error)) from None
        self._has_datum = False
        self._grid_from_first = self._world_from_grid = self._fix = None
        return {}


def _minus(a: tuple[float, float, float], b: tuple[float, float, float]) -> tuple[float, float, float]:
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def _finite_pose(message: Any) -> Pose | None:
    p, q = message.position, message.orientation
    norm = math.hypot(q.w, q.x, q.y, q.z)
    if not math.isfinite(p.x + p.y + p.z) or not 0.0 < norm < math.inf:
        return None
    return Pose((p.x, p.y, p.z), (q.w / norm, q.x / norm, q.y / norm, q.z / norm))
