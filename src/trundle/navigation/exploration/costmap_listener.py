"""A costmap from a topic, and updates from another."""

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from trundle.gazebo.nodes.rate import LogThrottle
from trundle.ros import Node

from ..costmap import FREE_SPACE, LETHAL, MAX_CELLS, NO_INFORMATION, Costmap
from ..occupancy_messages import read_cells
from ..pose_messages import read_pose

if TYPE_CHECKING:
    from trundle.ros.message_types import map_msgs, nav_msgs

_UNKNOWN = -1


class CostmapListener:
    """Keeps the latest costmap: free where the occupancy is 0, unknown where it is −1, else an obstacle."""

    def __init__(self, node: Node, topic: str, updates_topic: str) -> None:
        """Subscribe."""
        self.costmap: Costmap | None = None
        """None until the first message."""
        self.frame = ""
        self._warnings = LogThrottle(node, 5.0)
        node.subscribe(topic, "nav_msgs/OccupancyGrid", self._on_grid, queue_size=1)
        node.subscribe(updates_topic, "map_msgs/OccupancyGridUpdate", self._on_update, queue_size=10)

    def _on_grid(self, message: "nav_msgs.OccupancyGrid") -> None:
        info = message.info
        try:
            cells = read_cells(message)
            origin = read_pose(info.origin).position
            if not 0 < cells.size <= MAX_CELLS:
                raise ValueError(f"it has {cells.size} cells, not 1 to {MAX_CELLS}")
        except ValueError as error:
            self._warnings.warn(f"a costmap is ignored: {error}")
            return
        costmap = Costmap(info.width, info.height, float(info.resolution), (origin[0], origin[1]))
        costmap.cells = _costs(cells)
        self.costmap, self.frame = costmap, message.header.frame_id.lstrip("/")

    def _on_update(self, message: "map_msgs.OccupancyGridUpdate") -> None:
        if self.costmap is None:
            return
        x, y, width, height = message.x, message.y, message.width, message.height
        cells = np.asarray(message.data, dtype=np.int8)
        is_within = x >= 0 and y >= 0 and x + width <= self.costmap.width and y + height <= self.costmap.height
        if not is_within or cells.size != width * height:
            self._warnings.warn("an update is ignored: it is not inside the costmap, or has not width × height cells")
            return
        changed = self.costmap.copy()
        changed.cells[y : y + height, x : x + width] = _costs(cells.reshape(height, width))
        self.costmap = changed


def _costs(cells: NDArray[np.int8]) -> NDArray[np.uint8]:
    costs = np.full(cells.shape, LETHAL, dtype=np.uint8)
    costs[cells == 0] = FREE_SPACE
    costs[cells == _UNKNOWN] = NO_INFORMATION
    return costs
