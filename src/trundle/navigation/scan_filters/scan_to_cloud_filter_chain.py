"""laser_filters/scan_to_cloud_filter_chain: filters scans by a chain of filters, and projects them to clouds."""

import sys
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from trundle.gazebo.nodes import NodeHost
from trundle.gazebo.nodes.private_parameters import private_parameters
from trundle.gazebo.nodes.rate import LogThrottle
from trundle.robots.parameters import ParamError
from trundle.ros import Node, TransformError

from ..transform_filter import TransformFilter
from .chain import FilterChain
from .scan import Scan

if TYPE_CHECKING:
    from trundle.ros.message_types import sensor_msgs

_QUEUE = 50
_FLOAT, _INTEGER = 7, 5


class ScanToCloudFilterChain:
    """Publishes `cloud_filtered` from `scan`.

    Parameters, as the original's: scan_filter_chain, as that of scan_to_scan_filter_chain; target_frame base_link;
    laser_max_range, beyond which beams are left out. Points have an index, and an intensity where the laser measures
    one. A scan is transformed at its stamp, with high_fidelity, too; cloud_filter_chain is left out.
    """

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node

    async def run(self) -> int:
        """Filter until cancelled."""
        node = self._node
        self._warnings = LogThrottle(node, 1.0)
        parameters = await private_parameters(node)
        try:
            self._frame = parameters.text("target_frame", "base_link").lstrip("/")
            self._max_range = parameters.number("laser_max_range", sys.float_info.max)
            if not self._frame:
                raise ParamError(f"parameter {parameters.namespace}/target_frame is empty")
            self._held = TransformFilter(node, self._frame, self._filter, queue_size=_QUEUE)
            self._chain = FilterChain(parameters.sections("scan_filter_chain"), node, self._held.buffer)
            if parameters.items("cloud_filter_chain"):
                node.log.error("parameter cloud_filter_chain is left out; filters of clouds are not built in")
        except ParamError as error:
            node.log.fatal(str(error))
            return 1
        self._clouds = node.advertise("cloud_filtered", "sensor_msgs/PointCloud2", queue_size=10)
        node.subscribe("scan", "sensor_msgs/LaserScan", self._held.add, queue_size=_QUEUE)
        await node.closed.wait()
        return 0

    def _filter(self, message: "sensor_msgs.LaserScan") -> None:
        try:
            scan = Scan.read(message)
            fault = self._chain.apply(scan)
            pose = self._held.buffer.lookup_transform(self._frame, scan.frame, scan.stamp_ns).pose
        except (ValueError, TransformError) as error:
            fault = str(error)
        else:
            if not fault:
                scan.range_max = min(scan.range_max, self._max_range)
                self._clouds.publish(cloud_fields(scan, scan.points(pose), self._frame))
                return
        self._warnings.warn(f"a scan is dropped: {fault}")


def cloud_fields(scan: Scan, points: NDArray[np.float64], frame: str) -> dict[str, Any]:
    """Return the fields of a sensor_msgs/PointCloud2 of the beams' ends (n, 3) that are finite [m]."""
    has_intensities = len(scan.intensities) == len(points)
    names = ["x", "y", "z", *(["intensity"] if has_intensities else []), "index"]
    is_hit = np.isfinite(points).all(axis=1)
    rows = np.zeros(int(is_hit.sum()), dtype=[(name, "<i4" if name == "index" else "<f4") for name in names])
    for axis, name in enumerate("xyz"):
        rows[name] = points[is_hit, axis]
    if has_intensities:
        rows["intensity"] = scan.intensities[is_hit]
    rows["index"] = np.nonzero(is_hit)[0]
    step = rows.dtype.itemsize
    return {
        "header": {"stamp": scan.stamp_ns, "frame_id": frame},
        "height": 1,
        "width": len(rows),
        "fields": [
            {"name": name, "offset": 4 * i, "datatype": _INTEGER if name == "index" else _FLOAT, "count": 1}
            for i, name in enumerate(names)
        ],
        "point_step": step,
        "row_step": step * len(rows),
        "data": rows.tobytes(),
        "is_dense": True,
    }
