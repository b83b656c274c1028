"""A house of two rooms as a map, and scans in it."""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from trundle.navigation.localization._localization import OccupancyMap

RESOLUTION = 0.05
RANGE_MAX = 8.0
BEAMS = 360


def house_cells() -> NDArray[np.int8]:
    """6 m × 4 m, a wall with a door at x = 3.5 m, and a pillar."""
    cells = np.zeros((80, 120), dtype=np.int8)
    cells[[0, -1], :] = cells[:, [0, -1]] = 100
    cells[:50, 70] = cells[70:, 70] = 100
    cells[40:46, 20:26] = 100
    return cells


def house_map() -> OccupancyMap:
    return OccupancyMap(house_cells(), resolution=RESOLUTION, x=0.0, y=0.0)


def ranges_at(world: OccupancyMap, pose: tuple[float, float, float]) -> NDArray[np.float64]:
    """Exact ranges of a laser at a pose."""
    x, y, yaw = pose
    return np.array([world.cast_ray(x, y, yaw + bearing, RANGE_MAX) for bearing in bearings()])


def bearings() -> NDArray[np.float64]:
    return np.arange(BEAMS, dtype=np.float64) * (math.tau / BEAMS)


def map_fields(cells: NDArray[np.int8]) -> dict[str, Any]:
    """Fields of a nav_msgs/OccupancyGrid with its origin at (0, 0)."""
    height, width = cells.shape
    origin = {"orientation": {"w": 1.0}}
    info = {"resolution": RESOLUTION, "width": width, "height": height, "origin": origin}
    return {"header": {"frame_id": "map"}, "info": info, "data": cells.reshape(-1)}


def scan_fields(ranges: NDArray[np.float64], stamp_ns: int) -> dict[str, Any]:
    """Fields of a sensor_msgs/LaserScan in the frame base_scan."""
    return {
        "header": {"stamp": stamp_ns, "frame_id": "base_scan"},
        "angle_increment": math.tau / BEAMS,
        "angle_max": math.tau * (BEAMS - 1) / BEAMS,
        "range_min": 0.1,
        "range_max": RANGE_MAX,
        "ranges": ranges.tolist(),
    }
