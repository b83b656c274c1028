"""costmap_2d's publication of a costmap: the whole grid once, then the changed windows."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from trundle.ros import Node

from .costmap import INSCRIBED, LETHAL, NO_INFORMATION, Costmap


def _translation() -> NDArray[np.int8]:
    """Return the occupancy of each cost: 0 free, 1 … 98 by cost, 99 inscribed, 100 lethal, −1 unknown."""
    occupancies = np.array([1 + 97 * (cost - 1) // 251 for cost in range(256)], dtype=np.int16)
    occupancies[[0, INSCRIBED, LETHAL, NO_INFORMATION]] = 0, 99, 100, -1
    return occupancies.astype(np.int8)


OCCUPANCIES = _translation()


class CostmapPublisher:
    """Publishes a costmap as nav_msgs/OccupancyGrid, and the parts that change as map_msgs/OccupancyGridUpdate."""

    def __init__(self, node: Node, topic: str, frame: str, *, always_full: bool) -> None:
        self._node = node
        self._frame = frame
        self._always_full = always_full
        self._grids = node.advertise(
            topic, "nav_msgs/OccupancyGrid", latch=True, queue_size=1, on_connect=lambda _: self._publish_full()
        )
        self._updates = node.advertise(f"{topic}_updates", "map_msgs/OccupancyGridUpdate", queue_size=1)
        self._costmap: Costmap | None = None
        self._geometry: object = None
        self._changed: tuple[int, int, int, int] | None = None

    def change(self, window: tuple[int, int, int, int]) -> None:
        """Remember a changed window x0, y0, x1, y1 for the next publication."""
        x0, y0, x1, y1 = window
        if x0 >= x1 or y0 >= y1:
            return
        if self._changed is not None:
            a, b, c, d = self._changed
            x0, y0, x1, y1 = min(a, x0), min(b, y0), max(c, x1), max(d, y1)
        self._changed = (x0, y0, x1, y1)

    def publish(self, costmap: Costmap) -> None:
        """Publish the changed window; the whole grid if its origin or size changed."""
        self._costmap = costmap
        if self._geometry != costmap.geometry or self._always_full:
            self._geometry = costmap.geometry
            self._publish_full()
        elif self._changed is not None and self._updates.has_subscribers:
            x0, y0, x1, y1 = self._changed
            cells = OCCUPANCIES[costmap.cells[y0:y1, x0:x1]].reshape(-1)
            size = {"x": x0, "y": y0, "width": x1 - x0, "height": y1 - y0}
            self._updates.publish({"header": self._header(), **size, "data": cells})
        self._changed = None

    def _publish_full(self) -> None:
        costmap = self._costmap
        if costmap is None or not self._grids.has_subscribers:
            return
        header, (x, y) = self._header(), costmap.origin
        info: dict[str, Any] = {
            "map_load_time": header["stamp"],
            "resolution": costmap.resolution_m,
            "width": costmap.width,
            "height": costmap.height,
            "origin": {"position": {"x": x, "y": y}, "orientation": {"w": 1.0}},
        }
        self._grids.publish({"header": header, "info": info, "data": OCCUPANCIES[costmap.cells].reshape(-1)})

    def _header(self) -> dict[str, Any]:
        return {"stamp": self._node.clock.now_ns(), "frame_id": self._frame}
