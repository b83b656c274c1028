"""rrt_exploration/frontier_opencv_detector.py: frontier points of a map as a picture."""

import asyncio

import numpy as np
from numpy.typing import NDArray

from trundle.gazebo.nodes import NodeHost
from trundle.gazebo.nodes.private_parameters import private_parameters
from trundle.gazebo.nodes.rate import Rate
from trundle.navigation import _grids
from trundle.robots.parameters import ParamError
from trundle.ros import Node

from ..costmap import FREE_SPACE, LETHAL, NO_INFORMATION
from .map_listener import UNKNOWN, MapListener

_RATE_HZ = 50.0
_POLL_S = 0.1
_POINTS = 8
_OCCUPIED_FROM = 1
_MAX_REGIONS = 100
"""Number of regions of free cells that are searched."""


class FrontierDetector:
    """Publishes the middles of all frontiers of the map on `/detected_points`, each map's as often as the original.

    Parameter, with the original's default: map_topic /robot_1/map. `shapes` shows the last point. Frontiers are those
    cells of unknown space beside free cells that hang together, not the contours of a picture: the same places.
    """

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node

    async def run(self) -> int:
        """Detect until cancelled."""
        node = self._node
        try:
            topic = (await private_parameters(node)).text("map_topic", "/robot_1/map")
        except ParamError as error:
            node.log.fatal(str(error))
            return 1
        listener = MapListener(node, topic)
        points = node.advertise("/detected_points", "geometry_msgs/PointStamped", queue_size=10)
        shapes = node.advertise("shapes", "visualization_msgs/Marker", queue_size=10)
        seen: NDArray[np.int8] | None = None
        found: list[tuple[float, float]] = []
        rate = Rate(node, _RATE_HZ)
        while not node.closed.is_set():
            if not listener.cells.size:
                await node.clock.sleep(_POLL_S)
                continue
            if listener.cells is not seen:
                seen = listener.cells
                with node.loop.work.pending("the frontiers"):
                    found = await asyncio.to_thread(_middles, seen, listener.resolution_m, listener.origin)
            header = {"frame_id": listener.frame}
            for x, y in found:
                points.publish({"header": header, "point": {"x": x, "y": y}})
                dot = {"type": _POINTS, "scale": {"x": 0.3, "y": 0.3}, "color": {"r": 1.0, "a": 1.0}}
                place = {"ns": "markers", "pose": {"orientation": {"w": 1.0}}, "points": [{"x": x, "y": y}]}
                shapes.publish({"header": header, **dot, **place})
            await rate.sleep()
        return 0


def _middles(cells: NDArray[np.int8], resolution_m: float, origin: tuple[float, float]) -> list[tuple[float, float]]:
    """Return the middle of each frontier [m], of every region of free cells."""
    costs = np.full(cells.shape, LETHAL, dtype=np.uint8)
    costs[(cells >= 0) & (cells < _OCCUPIED_FROM)] = FREE_SPACE
    costs[cells == UNKNOWN] = NO_INFORMATION
    free = costs == FREE_SPACE
    middles: list[tuple[float, float]] = []
    for _ in range(_MAX_REGIONS):
        if not free.any():
            break
        row, column = (int(value) for value in np.argwhere(free)[0])
        region = _grids.wave_front(np.where(costs == FREE_SPACE, 1.0, 0.0).astype(np.float32), [(column, row)])
        free &= region >= _grids.UNREACHED
        frontiers = _grids.find_frontiers(costs, (column, row))
        for number in np.unique(frontiers[:, 0]):
            x, y = frontiers[frontiers[:, 0] == number, 1:].mean(axis=0).tolist()
            middles.append((origin[0] + (x + 0.5) * resolution_m, origin[1] + (y + 0.5) * resolution_m))
    return middles
