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

_HUGE, _LEAST = sys.float_info.max, sys.float_info.min
"""Defaults of the original, which takes std::numeric_limits::min, the smallest positive number, for the lowest."""
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
    nothing_m: float
    """Range of a ray without points [m]."""

    def ranges(self, points: NDArray[np.float64]) -> NDArray[np.float32]:
        """Range of the nearest point per ray [m]; `points` is (n, 3) in the scan's frame [m]."""
        x, y, z = points[np.isfinite(points).all(axis=1)].T
        distance, angle = np.hypot(x, y), np.arctan2(y, x)
        used = (z >= self.min_height_m) & (z <= self.max_height_m)
        used &= (distance >= self.range_min_m) & (distance <= self.range_max_m)
        used &= (angle >= self.angle_min) & (angle <= self.angle_max)
        count = math.ceil((self.angle_max - self.angle_min) / self.angle_increment)
        rays = ((angle[used] - self.angle_min) / self.angle_increment).astype(int)
        ranges = np.full(count, self.nothing_m)
        np.minimum.at(ranges, np.minimum(rays, count - 1), distance[used])
        return ranges.astype(np.float32)


class PointCloudToLaserScan:
    """Converts `cloud_in` to `scan` while `scan` has subscribers."""

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node
        self._waiting: Message | None = None
        """Cloud whose transform is not available yet."""
        self._why = ""

    async def run(self) -> int:
        """Convert until cancelled."""
        node = self._node
        settings = await private_parameters(node)
        farthest = settings.number("range_max", _HUGE)
        endless = settings.flag("use_inf", default=True)
        self._slice = Slice(
            min_height_m=settings.number("min_height", _LEAST),
            max_height_m=settings.number("max_height", _HUGE),
            angle_min=settings.number("angle_min", -math.pi),
            angle_max=settings.number("angle_max", math.pi),
            angle_increment=settings.number("angle_increment", math.pi / 180.0, above=0.0),
            range_min_m=settings.number("range_min", 0.0),
            range_max_m=farthest,
            nothing_m=math.inf if endless else farthest + settings.number("inf_epsilon", 1.0),
        )
        self._scan_time_s = settings.number("scan_time", 1.0 / 30.0)
        self._frame = settings.text("target_frame", "")
        self._listener = TransformListener(node) if self._frame else None
        self._complaints = LogThrottle(node, 5.0)
        self._scan = node.advertise("scan", "sensor_msgs/LaserScan", queue_size=10)
        clouds: Subscription | None = None
        while not node.closed.is_set():
            if self._scan.has_subscribers and clouds is None:
                clouds = node.subscribe("cloud_in", "sensor_msgs/PointCloud2", self._on_cloud, queue_size=1)
            elif not self._scan.has_subscribers and clouds is not None:
                clouds.unregister()
                clouds = None
            if self._waiting is not None:
                self._convert(self._waiting)
            await asyncio.sleep(_POLL_S)
        return 0

    def _on_cloud(self, cloud: "sensor_msgs.PointCloud2") -> None:
        if self._waiting is not None:
            self._complaints.warn(f"a cloud is dropped: {self._why}")
        self._convert(cloud)

    def _convert(self, cloud: "sensor_msgs.PointCloud2") -> None:
        """Publish a cloud's scan; without a transform yet, keep it until the next cloud."""
        self._waiting = None
        try:
            points = read_points(cloud)
            if self._listener is not None and self._frame != cloud.header.frame_id:
                stamp = to_nsec(cloud.header.stamp)
                points = _moved(
                    points, self._listener.buffer.lookup_transform(self._frame, cloud.header.frame_id, stamp).pose
                )
        except TransformError as error:
            self._waiting, self._why = cloud, str(error)
        except ValueError as error:
            self._complaints.warn(f"a cloud is dropped: {error}")
        else:
            self._scan.publish(self._fields(cloud, self._slice.ranges(points)))

    def _fields(self, cloud: "sensor_msgs.PointCloud2", ranges: NDArray[np.float32]) -> dict[str, Any]:
        cut = self._slice
        return {
            "header": {"stamp": cloud.header.stamp, "frame_id": self._frame or cloud.header.frame_id},
            "angle_min": cut.angle_min,
            "angle_max": cut.angle_max,
            "angle_increment": cut.angle_increment,
            "scan_time": self._scan_time_s,
            "range_min": cut.range_min_m,
            "range_max": min(cut.range_max_m, float(np.finfo(np.float32).max)),
            "ranges": ranges,
        }


def read_points(cloud: "sensor_msgs.PointCloud2") -> NDArray[np.float64]:
    """Points (n, 3) of a PointCloud2 [m].

    Raises:
        ValueError: fields x, y, z are missing, or the data is too short.
    """
    order = ">" if cloud.is_bigendian else "<"
    offsets = {field.name: (field.offset, _FLOATS.get(field.datatype)) for field in cloud.fields}
    kinds = [offsets.get(name, (0, None)) for name in "xyz"]
    if any(kind is None for _, kind in kinds):
        raise ValueError(f"no fields x, y, z of floats; there are: {', '.join(offsets) or 'none'}")
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


def _moved(points: NDArray[np.float64], target_from_cloud: Pose) -> NDArray[np.float64]:
    axes = np.array(
        [target_from_cloud.transform_vector(axis) for axis in ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))]
    )
    return points @ axes + np.array(target_from_cloud.position)
