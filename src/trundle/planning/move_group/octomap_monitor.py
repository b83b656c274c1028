"""Occupied space from depth sensors: occupancy_map_monitor's updaters, by ~sensors."""

import asyncio
import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from trundle.gazebo.nodes.depthimage_to_laserscan import read_depths
from trundle.gazebo.nodes.pointcloud_to_laserscan import read_points
from trundle.robots.parameters import ParamError, RosParameters
from trundle.ros import Node, RosError, to_nsec
from trundle.spatial import NS_PER_S, Pose

from .occupancy import OccupancyGrid
from .planning_scene_monitor import PlanningSceneMonitor
from .robot_filter import RobotFilter
from .scene import FrameError, pose_fields

if TYPE_CHECKING:
    from trundle.ros import Message

_CLOUDS = ("PointCloudOctomapUpdater",)
_DEPTHS = ("DepthImageOctomapUpdater",)
_MAX_POINTS = 60_000
"""Points of one update; of more, an even choice is taken."""


class OctomapMonitor:
    """Builds an octomap from the clouds and depth images of ~sensors, and puts it into the scene."""

    def __init__(self, node: Node, root: RosParameters, monitor: PlanningSceneMonitor) -> None:
        """Subscribe to the sensors; without ~sensors, nothing is done.

        Raises:
            ParamError: a setting is invalid.
        """
        self._node = node
        self._monitor = monitor
        self.model = monitor.model
        sensors = [entry for entry in root.sections("sensors") if entry.names()]
        if not sensors:
            return
        resolution = root.number("octomap_resolution", 0.1, above=0.0)
        self._frame = root.text("octomap_frame", monitor.model.model_frame)
        self._grid = OccupancyGrid(resolution)
        self._is_busy = False
        for entry in sensors:
            plugin = entry.text("sensor_plugin", "").rpartition("/")[2]
            if plugin in _CLOUDS:
                _CloudUpdater(node, entry, self)
            elif plugin in _DEPTHS:
                _DepthUpdater(node, entry, self)
            else:
                known = ", ".join((*_CLOUDS, *_DEPTHS))
                raise ParamError(f"{entry.namespace}/sensor_plugin: no updater '{plugin}'; updaters: {known}")

    async def add(
        self, points: NDArray[np.float64], frame: str, stamp_ns: int, *, max_range: float, filter: RobotFilter
    ) -> NDArray[np.float64] | None:
        """Add points (n, 3) [m] in a sensor's frame; return those that are in range and not the robot's.

        None: nothing was added, as others are being added, or the frame is unknown.
        """
        if self._is_busy:
            return None
        self._is_busy = True
        try:
            return await self._add(points, frame, stamp_ns, max_range, filter)
        finally:
            self._is_busy = False

    async def _add(
        self, points: NDArray[np.float64], frame: str, stamp_ns: int, max_range: float, filter: RobotFilter
    ) -> NDArray[np.float64] | None:
        monitor = self._monitor
        root = monitor.model.model_frame
        frames = monitor.frames()
        try:
            model_from_sensor = monitor.buffer.lookup_transform(root, frame, stamp_ns).pose
        except RosError:  # not at that time, or nobody publishes tf
            try:
                model_from_sensor = frames.find(frame)
            except FrameError as error:
                self._node.log.warn(f"Transform error of sensor data: {error}; quitting callback")
                return None
        poses = {name: frames.link(name) for name in monitor.model.links}
        contents = monitor.contents
        message, kept = await asyncio.to_thread(
            self._update, points, model_from_sensor, max_range, filter, poses, list(contents.carried.values())
        )
        changed = monitor.contents.copy()
        changed.octomap = self._node.new("octomap_msgs/OctomapWithPose", message)
        monitor.replace(changed)
        return kept

    def _update(
        self,
        points: NDArray[np.float64],
        model_from_sensor: Pose,
        max_range: float,
        filter: RobotFilter,
        poses: dict[str, Pose],
        carried: Sequence[Any],
    ) -> tuple[dict[str, Any], NDArray[np.float64]]:
        if len(points) > _MAX_POINTS:
            points = points[:: math.ceil(len(points) / _MAX_POINTS)]
        distances = np.linalg.norm(points, axis=1)
        is_near = np.isfinite(distances) & (distances > 0.0) & (distances <= max_range)
        near = points[is_near]
        hits = model_from_sensor_points(near, model_from_sensor)
        is_own = filter.mask(hits, poses, carried)
        self._grid.insert(np.array(model_from_sensor.position), hits[~is_own])
        self._grid.clear(hits[is_own])
        data = self._grid.binary()
        root = self._monitor.model.model_frame
        octomap = {"id": "OcTree", "binary": True, "resolution": self._grid.resolution, "data": data}
        message = {
            "header": {"frame_id": root},
            "origin": pose_fields(Pose()),
            "octomap": {"header": {"frame_id": root}, **octomap},
        }
        return message, near[~is_own]


def model_from_sensor_points(points: NDArray[np.float64], model_from_sensor: Pose) -> NDArray[np.float64]:
    """Return points (n, 3) in the model's frame."""
    axes = np.array([model_from_sensor.transform_vector(axis) for axis in ((1, 0, 0), (0, 1, 0), (0, 0, 1))])
    return points @ axes + np.array(model_from_sensor.position)


class _Pace:
    """Greatest rate of updates."""

    def __init__(self, node: Node, rate_hz: float) -> None:
        self._node = node
        self._period_ns = round(NS_PER_S / rate_hz) if rate_hz > 0.0 else 0
        self._last_ns = -self._period_ns

    def is_due(self) -> bool:
        now_ns = self._node.clock.now_ns()
        if 0 <= now_ns - self._last_ns < self._period_ns:
            return False
        self._last_ns = now_ns
        return True


class _CloudUpdater:
    """sensor_msgs/PointCloud2 of `point_cloud_topic`."""

    def __init__(self, node: Node, entry: RosParameters, monitor: OctomapMonitor) -> None:
        self._node = node
        self._monitor = monitor
        self._topic = entry.text("point_cloud_topic", "")
        self._max_range = entry.number("max_range", math.inf) if "max_range" in entry else math.inf
        self._step = max(1, entry.integer("point_subsample", 1))
        self._pace = _Pace(node, entry.number("max_update_rate", 0.0))
        self._filter = RobotFilter(
            monitor.model, entry.number("padding_offset", 0.0), entry.number("padding_scale", 1.0)
        )
        if not self._topic:
            raise ParamError(f"{entry.namespace}/point_cloud_topic is not set")
        shown = entry.text("filtered_cloud_topic", "")
        self._filtered = node.advertise(f"~{shown}", "sensor_msgs/PointCloud2", queue_size=10) if shown else None
        node.subscribe(self._topic, "sensor_msgs/PointCloud2", self._receive, queue_size=5, on_loop=True)
        node.log.info(f"Listening to '{node.resolve(self._topic)}' using message filter")

    async def _receive(self, cloud: "Message") -> None:
        if not self._pace.is_due():
            return
        try:
            points = read_points(cloud)
        except ValueError as error:
            self._node.log.error(f"{self._topic}: {error}")
            return
        kept = await self._monitor.add(
            points[:: self._step],
            str(cloud.header.frame_id),
            to_nsec(cloud.header.stamp),
            max_range=self._max_range,
            filter=self._filter,
        )
        if kept is not None and self._filtered is not None and self._filtered.has_subscribers:
            header = {"frame_id": cloud.header.frame_id, "stamp": to_nsec(cloud.header.stamp)}
            self._filtered.publish({"header": header, **_cloud_fields(kept)})


class _DepthUpdater:
    """sensor_msgs/Image of `image_topic`, with the camera_info beside it."""

    def __init__(self, node: Node, entry: RosParameters, monitor: OctomapMonitor) -> None:
        self._node = node
        self._monitor = monitor
        self._topic = entry.text("image_topic", "depth")
        self._near = entry.number("near_clipping_plane_distance", 0.3)
        self._far = entry.number("far_clipping_plane_distance", 5.0)
        self._skip = (
            max(0, entry.integer("skip_vertical_pixels", 4)),
            max(0, entry.integer("skip_horizontal_pixels", 6)),
        )
        self._pace = _Pace(node, entry.number("max_update_rate", 0.0))
        self._filter = RobotFilter(
            monitor.model, entry.number("padding_offset", 0.02), entry.number("padding_scale", 1.0)
        )
        self._camera: Message | None = None
        info = f"{self._topic.rpartition('/')[0]}/camera_info"
        node.subscribe(info, "sensor_msgs/CameraInfo", self._set_camera, queue_size=5, on_loop=True)
        node.subscribe(self._topic, "sensor_msgs/Image", self._receive, queue_size=5, on_loop=True)
        node.log.info(f"Listening to '{node.resolve(self._topic)}' and '{node.resolve(info)}'")

    def _set_camera(self, message: "Message") -> None:
        self._camera = message

    async def _receive(self, image: "Message") -> None:
        if self._camera is None or not self._pace.is_due():
            return
        try:
            depths = read_depths(image)
        except (KeyError, ValueError) as error:
            self._node.log.error(f"{self._topic}: an image of encoding '{image.encoding}' is no depth image ({error})")
            return
        points = _points_of(depths, self._camera, self._skip)
        is_near = (points[:, 2] >= self._near) & (points[:, 2] <= self._far)
        await self._monitor.add(
            points[is_near],
            str(image.header.frame_id),
            to_nsec(image.header.stamp),
            max_range=math.inf,
            filter=self._filter,
        )


def _cloud_fields(points: NDArray[np.float64]) -> dict[str, Any]:
    """Return the fields of a sensor_msgs/PointCloud2 of points (n, 3)."""
    fields = [{"name": name, "offset": 4 * index, "datatype": 7, "count": 1} for index, name in enumerate("xyz")]
    size = {"height": 1, "width": len(points), "point_step": 12, "row_step": 12 * len(points)}
    return {**size, "fields": fields, "is_dense": True, "data": np.frombuffer(points.astype("<f4").tobytes(), np.uint8)}


def _points_of(depths: NDArray[np.float64], camera: "Message", skip: tuple[int, int]) -> NDArray[np.float64]:
    """Return the points (n, 3) of a depth image in the camera's optical frame; REP 104's pinhole model."""
    matrix = np.asarray(camera.K, dtype=np.float64)
    fx, cx, fy, cy = matrix[0], matrix[2], matrix[4], matrix[5]
    height, width = depths.shape
    if not fx > 0.0 or not fy > 0.0:
        return np.zeros((0, 3))
    v, u = np.mgrid[skip[0] : max(height - skip[0], skip[0]), skip[1] : max(width - skip[1], skip[1])]
    z = depths[v, u]
    points = np.stack([(u - cx) * z / fx, (v - cy) * z / fy, z], axis=-1).reshape(-1, 3)
    return points[np.isfinite(points[:, 2])]
