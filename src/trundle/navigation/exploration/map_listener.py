"""An occupancy grid from a topic, and what its cells say around points."""

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from trundle.gazebo.nodes.rate import LogThrottle
from trundle.ros import Node

from ..costmap import MAX_CELLS
from ..occupancy_messages import read_cells
from ..pose_messages import read_pose
from .frontier import Point

if TYPE_CHECKING:
    from trundle.ros.message_types import nav_msgs

OCCUPIED, UNKNOWN = 100, -1


class MapListener:
    """Keeps the latest map of a topic."""

    def __init__(self, node: Node, topic: str) -> None:
        """Subscribe."""
        self.cells: NDArray[np.int8] = np.empty((0, 0), dtype=np.int8)
        """(height, width); empty until the first message."""
        self.frame = ""
        self.resolution_m = 1.0
        self.origin: Point = (0.0, 0.0)
        self._warnings = LogThrottle(node, 5.0)
        node.subscribe(topic, "nav_msgs/OccupancyGrid", self._on_grid, queue_size=1)

    def _on_grid(self, message: "nav_msgs.OccupancyGrid") -> None:
        try:
            cells = read_cells(message)
            origin = read_pose(message.info.origin).position
            if not 0 < cells.size <= MAX_CELLS:
                raise ValueError(f"it has {cells.size} cells, not 1 to {MAX_CELLS}")
        except ValueError as error:
            self._warnings.warn(f"a map is ignored: {error}")
            return
        self.cells, self.frame = cells, message.header.frame_id.lstrip("/")
        self.resolution_m, self.origin = float(message.info.resolution), (origin[0], origin[1])

    def values(self, points: NDArray[np.float64]) -> NDArray[np.int8]:
        """Return the occupancies at points (n, 2) [m]; OCCUPIED outside the map."""
        cells = np.floor((points - self.origin) / self.resolution_m)
        height, width = self.cells.shape
        is_inside = np.all((cells >= 0) & (cells < (width, height)), axis=1)
        found = np.full(len(points), OCCUPIED, dtype=np.int8)
        columns, rows = cells[is_inside].astype(np.intp).T
        found[is_inside] = self.cells[rows, columns]
        return found

    def unknown_near(self, point: Point, radius_m: float) -> NDArray[np.float64]:
        """Return the centers (n, 2) [m] of unknown cells within a radius."""
        (x, y), size = point, self.resolution_m
        low = [max(int((value - radius_m - start) / size), 0) for value, start in zip(point, self.origin, strict=True)]
        high = [
            max(int((value + radius_m - start) / size) + 1, 0) for value, start in zip(point, self.origin, strict=True)
        ]
        rows, columns = np.nonzero(self.cells[low[1] : high[1], low[0] : high[0]] == UNKNOWN)
        cells = np.stack([columns + low[0], rows + low[1]], axis=1).astype(np.float64)
        centers = (cells + 0.5) * size + np.array(self.origin)
        return centers[np.hypot(centers[:, 0] - x, centers[:, 1] - y) <= radius_m]

    def information_gain(self, point: Point, radius_m: float) -> float:
        """Return the unknown area [m²] within a radius."""
        return len(self.unknown_near(point, radius_m)) * self.resolution_m**2
