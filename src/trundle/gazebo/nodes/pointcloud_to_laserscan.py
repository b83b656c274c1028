"""pointcloud_to_laserscan: converts a horizontal slice of a point cloud to a laser scan."""

import asyncio
import math
import sys
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from trundle.ros import Message, Node, Subscription, TransformError, TransformListener, to_nsec
from trundle.spatial import Pose

from .host import NodeHost
from .private_parameters import private_parameters
from .rate import LogThrottle

if TYPE_CHECKING:
    from trundle.ros.message_types import sensor_msgs

_MAX_FLOAT, _MIN_FLOAT = sys.float_info.max, sys.float_info.min
"""Defaults of the original; its minimum is std::numeric_limits::min, the smallest positive number."""
_POLL_S = 0.02
_FLOATS = {7: "f4", 8: "f8"}
"""Datatype numbers of floats in sensor_msgs/PointField."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Slice:
    """Height, angle and range limits of the scan."""

    min_height_m: float
    max_height_m: float
    angle_min: float
    angle_max: float
    angle_increment: float
    """[rad]"""
    range_min_m: float
    range_max_m: float
    empty_range_m: float
    """Range of a ray without points [m]."""

    def ranges(self, points: NDArray[np.float64]) -> NDArray[np.float32]:
        """Return the range of the nearest point per ray [m]; `points` is (n, 3) in the scan's frame [m]."""
        x, y, z = points[np.isfinite(points).all(axis=1)].T
        distance, angle = np.hypot(x, y), np.arctan2(y, x)
        is_used = (z >= self.min_height_m) & (z <= self.max_height_m)
        is_used &= (distance >= self.range_min_m) & (distance <= self.range_max_m)
        is_used &= (angle >= self.angle_min) & (angle <= self.angle_max)
        count = math.ceil((self.angle_max - self.angle_min) / self.angle_increment)
        rays = ((angle[is_used] - self.angle_min) / self.angle_increment).astype(int)
        ranges = np.full(count, self.empty_range_m)
        np.minimum.at(ranges, np.minimum(rays, count - 1), distance[is_used])
        return ranges.astype(np.float32)


class PointCloudToLaserScan:
    """Converts `cloud_in` to `scan` while `scan` has subscribers."""

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node
        self._waiting_cloud: Message | None = None
        """Cloud whose transform is not available yet."""
        self._waiting_reason = ""

    async def run(self) -> int:
        """Convert until cancelled."""
        node = self._node
        settings = await private_parameters(node)
        range_max = settings.number("range_max", _MAX_FLOAT)
        use_inf = settings.flag("use_inf", default=True)
        self._slice = Slice(
            min_height_m=settings.number("min_height", _MIN_FLOAT),
            max_height_m=settings.number("max_height", _MAX_FLOAT),
            angle_min=settings.number("angle_min", -math.pi),
            angle_max=settings.number("angle_max", math.pi),
            angle_increment=settings.number("angle_increment", math.pi / 180.0, above=0.0),
            range_min_m=settings.number("range_min", 0.0),
            range_max_m=range_max,
            empty_range_m=math.inf if use_inf else range_max + settings.number("inf_epsilon", 1.0),
        )
        self._scan_time_s = settings.number("scan_time", 1.0 / 30.0)
        self._frame = settings.text("target_frame", "")
        self._listener = TransformListener(node) if self._frame else None
        self._warnings = LogThrottle(node, 5.0)
        self._scan = node.advertise("scan", "sensor_msgs/LaserScan", queue_size=10)
        clouds: Subscription | None = None
        while not node.closed.is_set():
            if self._scan.has_subscribers and clouds is None:
                clouds = node.subscribe("cloud_in", "sensor_msgs/PointCloud2", self._on_cloud, queue_size=1)
            elif not self._scan.has_subscribers and clouds is not None:
                clouds.unregister()
                clouds = None
            if self._waiting_cloud is not None:
                self._convert(self._waiting_cloud)
            await asyncio.sleep(_POLL_S)
        return 0

    def _on_cloud(self, cloud: "sensor_msgs.PointCloud2") -> None:
        if self._waiting_cloud is not None:
            self._warnings.warn(f"a cloud is dropped: {self._waiting_reason}")
        self._convert(cloud)

    def _convert(self, cloud: "sensor_msgs.PointCloud2") -> None:
        """Publish a cloud's scan; without a transform yet, keep it until the next cloud."""
        self._waiting_cloud = None
        try:
            points = read_points(cloud)
            if self._listener is not None and self._frame != cloud.header.frame_id:
                stamp = to_nsec(cloud.header.stamp)
                points = _transform_points(
                    points, self._listener.buffer.lookup_transform(self._frame, cloud.header.frame_id, stamp).pose
                )
        except TransformError as error:
            self._waiting_cloud, self._waiting_reason = cloud, str(error)
        except ValueError as error:
            self._warnings.warn(f"a cloud is dropped: {error}")
        else:
            self._scan.publish(self._fields(cloud, self._slice.ranges(points)))

    def _fields(self, cloud: "sensor_msgs.PointCloud2", ranges: NDArray[np.float32]) -> dict[str, Any]:
        slice_ = self._slice
        return {
            "header": {"stamp": cloud.header.stamp, "frame_id": self._frame or cloud.header.frame_id},
            "angle_min": slice_.angle_min,
            "angle_max": slice_.angle_max,
            "angle_increment": slice_.angle_increment,
            "scan_time": self._scan_time_s,
            "range_min": slice_.range_min_m,
            "range_max": min(slice_.range_max_m, float(np.finfo(np.float32).max)),
            "ranges": ranges,
        }


def read_points(cloud: "sensor_msgs.PointCloud2") -> NDArray[np.float64]:
    """Return the points (n, 3) of a PointCloud2 [m].

    Raises:
        ValueError: fields x, y, z are missing, or the data is too short.
    """
    order = ">" if cloud.is_bigendian else "<"
    offsets = {field.name: (field.offset, _FLOATS.get(field.datatype)) for field in cloud.fields}
    kinds = [offsets.get(name, (0, None)) for name in "xyz"]
    if any(kind is None for _, kind in kinds):
        raise ValueError(f"no fields x, y, z of floats; fields: {', '.join(offsets) or 'none'}")
    layout = np.dtype(
        {
            "names": list("xyz"),
            "formats": [f"{order}{kind}" for _, kind in kinds],
            "offsets": [offset for offset, _ in kinds],
            "itemsize": cloud.point_step,
        }
    )
    count = cloud.width * cloud.height
    records = np.frombuffer(bytes(cloud.data), dtype=layout, count=count)
    return np.stack([records[name].astype(np.float64) for name in "xyz"], axis=1)


def _transform_points(points: NDArray[np.float64], target_from_cloud: Pose) -> NDArray[np.float64]:
    axes = np.array(
        [target_from_cloud.transform_vector(axis) for axis in ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))]
    )
    return points @ axes + np.array(target_from_cloud.position)
