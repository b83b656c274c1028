"""Map and markers of a pose graph, as messages."""

import asyncio
from typing import Any

import numpy as np

from . import _mapping

_OCCUPIED_SHARE = 0.1
"""Share of the beams through a cell that end in it, beyond which it is occupied, as in Karto."""
_MAX_CELLS = 400_000_000
_MARGIN = 1
"""Unknown cells around what was seen."""
_SPHERES, _LINES = 7, 5


class GraphMap:
    """The occupancy grid of what the scans of a graph saw."""

    def __init__(self, slam: _mapping.GraphSlam, *, frame: str, resolution: float) -> None:
        self._slam = slam
        self._frame = frame
        self._resolution = resolution
        self.message: dict[str, Any] | None = None
        """nav_msgs/OccupancyGrid; None: nothing was seen yet."""

    async def draw(self, stamp_ns: int) -> bool:
        """Draw the map beside the graph's thread; False: it has no or too many cells."""
        first_column, first_row, last_column, last_row = await asyncio.to_thread(self._slam.seen)
        width, height = last_column - first_column + 1 + 2 * _MARGIN, last_row - first_row + 1 + 2 * _MARGIN
        if last_column < first_column or width * height > _MAX_CELLS:
            return False
        cells = await asyncio.to_thread(
            self._slam.draw,
            first_column=first_column - _MARGIN,
            first_row=first_row - _MARGIN,
            width=width,
            height=height,
            occupied_threshold=_OCCUPIED_SHARE,
        )
        position = {
            "x": (first_column - _MARGIN) * self._resolution,
            "y": (first_row - _MARGIN) * self._resolution,
        }
        info = {
            "map_load_time": stamp_ns,
            "resolution": self._resolution,
            "width": width,
            "height": height,
            "origin": {"position": position, "orientation": {"w": 1.0}},
        }
        header = {"stamp": stamp_ns, "frame_id": self._frame}
        self.message = {"header": header, "info": info, "data": cells.reshape(-1)}
        return True


def graph_markers(slam: _mapping.GraphSlam, *, frame: str, stamp_ns: int) -> dict[str, Any]:
    """Return the graph as a visualization_msgs/MarkerArray: nodes and what links them."""
    poses, constraints = slam.poses(), slam.constraints()
    points = [{"x": x, "y": y} for x, y, _ in poses.tolist()]
    ends = constraints[:, :2].astype(np.int64).ravel().tolist()
    header = {"stamp": stamp_ns, "frame_id": frame}
    common = {"header": header, "ns": "pose_graph", "pose": {"orientation": {"w": 1.0}}}
    spheres = {
        **common,
        "id": 0,
        "type": _SPHERES,
        "scale": {"x": 0.1, "y": 0.1, "z": 0.1},
        "color": {"r": 1.0, "a": 1.0},
        "points": points,
    }
    lines = {
        **common,
        "id": 1,
        "type": _LINES,
        "scale": {"x": 0.02},
        "color": {"b": 1.0, "a": 1.0},
        "points": [points[end] for end in ends],
    }
    return {"markers": [spheres, lines]}
