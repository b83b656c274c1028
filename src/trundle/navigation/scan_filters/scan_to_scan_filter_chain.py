"""laser_filters/scan_to_scan_filter_chain: filters scans by a chain of filters."""

from typing import TYPE_CHECKING

from trundle.gazebo.nodes import NodeHost
from trundle.gazebo.nodes.private_parameters import private_parameters
from trundle.gazebo.nodes.rate import LogThrottle
from trundle.robots.parameters import ParamError
from trundle.ros import Node, TransformListener

from ..transform_filter import TransformFilter
from .chain import FilterChain
from .scan import Scan

if TYPE_CHECKING:
    from trundle.ros.message_types import sensor_msgs

_QUEUE = 50


class ScanToScanFilterChain:
    """Publishes `scan_filtered` from `scan`.

    Parameters, as the original's: scan_filter_chain, a list of {name, type, params}; tf_message_filter_target_frame: a
    frame into which scans must be transformable before they are filtered. Filters: range, intensity, angular bounds,
    sector, interpolation, mask, shadows, speckle, footprint, box, polygon, and means and medians over time.
    """

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node

    async def run(self) -> int:
        """Filter until cancelled."""
        node = self._node
        self._warnings = LogThrottle(node, 1.0)
        parameters = await private_parameters(node)
        name = "scan_filter_chain"
        if "filter_chain" in parameters:
            name = "filter_chain"
            node.log.warn("parameter ~filter_chain is deprecated; its new name is ~scan_filter_chain")
        try:
            target = parameters.text("tf_message_filter_target_frame", "").lstrip("/")
            held = TransformFilter(node, target, self._filter, queue_size=_QUEUE) if target else None
            buffer = held.buffer if held is not None else TransformListener(node).buffer
            self._chain = FilterChain(parameters.sections(name), node, buffer)
        except ParamError as error:
            node.log.fatal(str(error))
            return 1
        self._filtered = node.advertise("scan_filtered", "sensor_msgs/LaserScan", queue_size=_QUEUE)
        receive = self._filter if held is None else held.add
        node.subscribe("scan", "sensor_msgs/LaserScan", receive, queue_size=_QUEUE)
        await node.closed.wait()
        return 0

    def _filter(self, message: "sensor_msgs.LaserScan") -> None:
        try:
            scan = Scan.read(message)
            fault = self._chain.apply(scan)
        except ValueError as error:
            fault = str(error)
        else:
            if not fault:
                self._filtered.publish(scan.fields())
                return
        self._warnings.warn(f"a scan is dropped: {fault}")
