"""An occupancy tree as messages: octomaps, markers, points, and a map of the ground."""

import colorsys
import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ._octomaps import OccupancyTree
from .octomap_settings import Color

_DEPTH = 16
_CUBE_LIST, _ADD, _DELETE = 6, 0, 2
_FLOAT = 7
_MAX_CELLS = 100_000_000


class Cubes(NamedTuple):
    """Cubes of several sizes."""

    centers: NDArray[np.float64]
    """(n, 3) [m]"""
    depths: NDArray[np.int64]
    """(n,) levels below the tree's first cube: 16 are the smallest."""


def read_cubes(tree: OccupancyTree, *, occupied: bool, low: float, high: float) -> Cubes:
    """Return the free or occupied cubes that reach between two heights [m]."""
    rows = tree.leaves(occupied=occupied).astype(np.int64)
    sizes = tree.resolution * 2.0 ** (_DEPTH - rows[:, 3])
    centers = (rows[:, :3] + 0.5) * sizes[:, None] - tree.resolution * 2.0 ** (_DEPTH - 1)
    is_used = (centers[:, 2] + 0.5 * sizes > low) & (centers[:, 2] - 0.5 * sizes < high)
    return Cubes(centers[is_used], rows[is_used, 3])


def octomap_fields(tree: OccupancyTree, header: dict[str, Any], *, binary: bool) -> dict[str, Any]:
    """Return the fields of an octomap_msgs/Octomap."""
    data = tree.binary() if binary else tree.full()
    return {
        "header": header,
        "binary": binary,
        "id": "OcTree",
        "resolution": tree.resolution,
        "data": data.view(np.int8),
    }


def marker_fields(
    cubes: Cubes, resolution: float, header: dict[str, Any], color: Color, *, height_factor: float | None
) -> dict[str, Any]:
    """Return the fields of a visualization_msgs/MarkerArray: a list of cubes for each size.

    `height_factor`: share of the circle of hues that the heights go through; None: all have one color.
    """
    markers: list[dict[str, Any]] = []
    heights = cubes.centers[:, 2]
    low, high = (float(heights.min()), float(heights.max())) if len(heights) else (0.0, 0.0)
    for depth in range(_DEPTH + 1):
        centers = cubes.centers[cubes.depths == depth]
        size = resolution * 2.0 ** (_DEPTH - depth)
        marker: dict[str, Any] = {
            "header": header,
            "ns": header["frame_id"],
            "id": depth,
            "type": _CUBE_LIST,
            "action": _ADD if len(centers) else _DELETE,
            "scale": {"x": size, "y": size, "z": size},
            "pose": {"orientation": {"w": 1.0}},
            "color": color._asdict(),
            "points": [{"x": x, "y": y, "z": z} for x, y, z in centers.tolist()],
        }
        if height_factor is not None:
            span = max(high - low, 1e-9)
            shares = [height_factor * (1.0 - (z - low) / span) for z in centers[:, 2].tolist()]
            marker["colors"] = [_hue(share) for share in shares]
        markers.append(marker)
    return {"markers": markers}


def _hue(share: float) -> dict[str, float]:
    r, g, b = colorsys.hsv_to_rgb(share % 1.0, 1.0, 1.0)
    return {"r": r, "g": g, "b": b, "a": 1.0}


def cloud_fields(cubes: Cubes, header: dict[str, Any]) -> dict[str, Any]:
    """Return the fields of a sensor_msgs/PointCloud2 of the cubes' centers."""
    data = cubes.centers.astype("<f4")
    return {
        "header": header,
        "height": 1,
        "width": len(data),
        "fields": [{"name": name, "offset": 4 * i, "datatype": _FLOAT, "count": 1} for i, name in enumerate("xyz")],
        "point_step": 12,
        "row_step": 12 * len(data),
        "data": np.frombuffer(data.tobytes(), np.uint8),
        "is_dense": True,
    }


def map_fields(
    tree: OccupancyTree, header: dict[str, Any], heights: tuple[float, float], least: tuple[float, float]
) -> dict[str, Any]:
    """Return the fields of a nav_msgs/OccupancyGrid.

    Args:
        tree: cubes that are projected.
        header: of the message.
        heights: lowest and highest cubes of the projection [m].
        least: least width and height of the map, about the origin [m].

    Raises:
        ValueError: the map has too many cells.
    """
    x, y, cells = tree.project(*heights)
    size, center = tree.resolution, 1 << (_DEPTH - 1)
    if not cells.size:
        x = y = center
    (left, right), (below, above) = (
        _padding(first, count, half_m / 2.0 / size, center)
        for first, count, half_m in zip((x, y), (cells.shape[1], cells.shape[0]), least, strict=True)
    )
    columns, rows = left + cells.shape[1] + right, below + cells.shape[0] + above
    if columns * rows > _MAX_CELLS:
        raise ValueError(f"{columns} × {rows} cells; at most {_MAX_CELLS}")
    cells = np.pad(cells, ((below, above), (left, right)), constant_values=-1)
    position = {"x": (x - left - center) * size, "y": (y - below - center) * size}
    info = {
        "map_load_time": header["stamp"],
        "resolution": size,
        "width": cells.shape[1],
        "height": cells.shape[0],
        "origin": {"position": position, "orientation": {"w": 1.0}},
    }
    return {"header": header, "info": info, "data": cells.reshape(-1)}


def _padding(first: int, count: int, half: float, center: int) -> tuple[int, int]:
    """Return the number of cells to add before and after, so that ±`half` cells about the center are covered."""
    before = first - math.floor(center - half)
    after = math.ceil(center + half) - (first + count)
    return max(0, before), max(0, after)
