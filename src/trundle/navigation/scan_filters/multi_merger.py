"""ira_laser_tools/laserscan_multi_merger: makes one scan of several lasers' scans."""

import math
import sys
from functools import partial
from typing import TYPE_CHECKING, Annotated

import numpy as np
from msgspec import Meta, Struct
from numpy.typing import NDArray

from trundle.gazebo.nodes import NodeHost
from trundle.gazebo.nodes.pointcloud_to_laserscan import Slice
from trundle.gazebo.nodes.private_parameters import private_parameters
from trundle.gazebo.nodes.rate import LogThrottle
from trundle.robots.parameters import ParamError
from trundle.ros import Node, TransformError

from ..settings import read_settings, reconfigure
from ..transform_filter import TransformFilter
from .scan import Scan

if TYPE_CHECKING:
    from trundle.ros.message_types import sensor_msgs

_Angle = Annotated[float, Meta(ge=-math.pi, le=math.pi)]
_MAX_BEAMS = 1_000_000
_QUEUE = 5


class MergerSettings(Struct):
    """The merged scan: angles [rad], ranges [m], times [s]."""

    angle_min: _Angle = -2.36
    angle_max: _Angle = 2.36
    angle_increment: Annotated[float, Meta(ge=0.0, le=math.pi)] = 0.0058
    time_increment: Annotated[float, Meta(ge=0.0, le=1.0)] = 0.0
    scan_time: Annotated[float, Meta(ge=0.0, le=1.0)] = 0.0333333
    range_min: Annotated[float, Meta(ge=0.0, le=50.0)] = 0.45
    range_max: Annotated[float, Meta(ge=0.0, le=1000.0)] = 25.0

    @property
    def is_valid(self) -> bool:
        """True if there are beams, and not too many."""
        return self.angle_max > self.angle_min and (self.angle_max - self.angle_min) < _MAX_BEAMS * self.angle_increment


class LaserscanMultiMerger:
    """Publishes a scan and a cloud of all lasers whenever each has measured.

    Parameters, with the original's names and defaults: destination_frame cart_frame, cloud_destination_topic
    /merged_cloud, scan_destination_topic /scan_multi, laserscan_topics (names with spaces between), and those of
    `MergerSettings`, which dynamic_reconfigure changes. A beam without a hit is 1 m longer than range_max. Scans wait
    for the transform at their stamp.
    """

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node
        self._points: dict[str, NDArray[np.float64] | None] = {}
        """Topic → its points (n, 3) that wait for those of the other topics."""
        self._held: dict[str, TransformFilter] = {}

    async def run(self) -> int:
        """Merge until cancelled."""
        node = self._node
        try:
            parameters = await private_parameters(node)
            self._settings = read_settings(MergerSettings, parameters)
            self._frame = parameters.text("destination_frame", "cart_frame").lstrip("/")
            topics = sorted(set(parameters.text("laserscan_topics", "").split()))
            if not topics:
                raise ParamError(f"{parameters.namespace}: no lasers; set laserscan_topics, as '/front /rear'")
            if not self._settings.is_valid:
                raise ParamError(
                    f"{parameters.namespace}: angle_min … angle_max by angle_increment is 1 to {_MAX_BEAMS} beams"
                )
        except ParamError as error:
            node.log.fatal(str(error))
            return 1
        reconfigure(node, "~", self._settings, self._check)
        self._warnings = LogThrottle(node, 5.0)
        cloud_topic = parameters.text("cloud_destination_topic", "/merged_cloud")
        self._clouds = node.advertise(cloud_topic, "sensor_msgs/PointCloud2", queue_size=1)
        scan_topic = parameters.text("scan_destination_topic", "/scan_multi")
        self._scans = node.advertise(scan_topic, "sensor_msgs/LaserScan", queue_size=1)
        for topic in topics:
            self._points[topic] = None
            receive = partial(self._on_scan, topic)
            self._held[topic] = TransformFilter(node, self._frame, receive, queue_size=_QUEUE)
            node.subscribe(topic, "sensor_msgs/LaserScan", self._held[topic].add, queue_size=_QUEUE)
        await node.closed.wait()
        return 0

    def _check(self) -> None:
        if not self._settings.is_valid:
            self._warnings.warn("no scan is published: angle_min … angle_max by angle_increment makes no beams")

    def _on_scan(self, topic: str, message: "sensor_msgs.LaserScan") -> None:
        try:
            scan = Scan.read(message)
            pose = self._held[topic].buffer.lookup_transform(self._frame, scan.frame, scan.stamp_ns).pose
        except (ValueError, TransformError) as error:
            self._warnings.warn(f"a scan is dropped: {error}")
            return
        points = scan.points(pose)
        self._points[topic] = points[np.isfinite(points[:, 0])]
        if all(points is not None for points in self._points.values()):
            merged = np.concatenate([points for points in self._points.values() if points is not None])
            self._points = dict.fromkeys(self._points)
            self._publish(merged, scan.stamp_ns)

    def _publish(self, points: NDArray[np.float64], stamp_ns: int) -> None:
        settings = self._settings
        header = {"stamp": stamp_ns, "frame_id": self._frame}
        fields = [{"name": name, "offset": 4 * i, "datatype": 7, "count": 1} for i, name in enumerate("xyz")]
        self._clouds.publish(
            {
                "header": header,
                "height": 1,
                "width": len(points),
                "fields": fields,
                "point_step": 12,
                "row_step": 12 * len(points),
                "data": points.astype("<f4").tobytes(),
                "is_dense": True,
            }
        )
        if not settings.is_valid:
            return
        slice_ = Slice(
            min_height_m=-sys.float_info.max,
            max_height_m=sys.float_info.max,
            angle_min=settings.angle_min,
            angle_max=settings.angle_max,
            angle_increment=settings.angle_increment,
            range_min_m=settings.range_min,
            range_max_m=settings.range_max + 1.0,
            empty_range_m=settings.range_max + 1.0,
        )
        times = {"time_increment": settings.time_increment, "scan_time": settings.scan_time}
        bounds = {"range_min": settings.range_min, "range_max": settings.range_max}
        angles = {"angle_min": settings.angle_min, "angle_max": settings.angle_max}
        self._scans.publish(
            {
                "header": header,
                **angles,
                "angle_increment": settings.angle_increment,
                **times,
                **bounds,
                "ranges": slice_.ranges(points),
            }
        )
