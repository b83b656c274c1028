"""frontier_exploration's BoundedExploreLayer: the edge of a polygon is an obstacle."""

import math

import msgspec
import numpy as np
from numpy.typing import NDArray

from .costmap import LETHAL, MAX_CELLS, NO_INFORMATION, Bounds, Costmap

_MAX_CORNERS = 10_000


class BoundedExploreSettings(msgspec.Struct, kw_only=True):
    """Parameters, with the original's defaults."""

    enabled: bool = True
    explore_clear_space: bool = True
    """True: cells that the layers below hold as free become unknown."""
    resize_to_boundary: bool = True
    """True: the costmap's size becomes that of the polygon."""
    frontier_travel_point: str = "closest"
    """Point of a frontier to drive to: closest, middle or centroid."""


class BoundedExploreLayer:
    """Marks the edge of a polygon as an obstacle; `set_boundary` sets the polygon."""

    is_current = True

    def __init__(self, name: str, master: Costmap, settings: BoundedExploreSettings) -> None:
        """Take the costmap and the settings."""
        self.name = name
        self.options = settings
        self._master = master
        self._polygon: NDArray[np.float64] | None = None

    def set_boundary(self, polygon: NDArray[np.float64]) -> None:
        """Use the corners (n, 2) of a polygon in the costmap's frame [m]; without corners there is no edge.

        Raises:
            ValueError: it has too many corners, is not finite, or covers too many cells.
        """
        if len(polygon) > _MAX_CORNERS or not np.isfinite(polygon).all():
            raise ValueError(f"a boundary has at most {_MAX_CORNERS} finite corners")
        if len(polygon) and self.options.resize_to_boundary:
            self._resize(polygon)
        self._polygon = polygon if len(polygon) else None

    def _resize(self, polygon: NDArray[np.float64]) -> None:
        low, high = polygon.min(axis=0), polygon.max(axis=0)
        width, height = (math.ceil(length / self._master.resolution_m) + 2 for length in (high - low).tolist())
        if width * height > MAX_CELLS:
            raise ValueError(f"a boundary of {width} × {height} cells exceeds the limit of {MAX_CELLS}")
        self._master.width, self._master.height = width, height
        self._master.origin = (float(low[0]) - self._master.resolution_m, float(low[1]) - self._master.resolution_m)
        self._master.clear()

    @property
    def enabled(self) -> bool:
        """True if the layer takes part in updates."""
        return self.options.enabled

    def change(self) -> None:
        """See `Layer`."""

    def match_size(self) -> None:
        """See `Layer`."""

    def reset(self) -> None:
        """Forget the boundary."""
        self._polygon = None

    def update_bounds(self, robot: tuple[float, float, float], bounds: Bounds) -> None:
        """Extend the bounds to the whole costmap, once there is a boundary."""
        del robot
        if self._polygon is not None:
            bounds.touch_all(self._master)

    def update_costs(self, master: Costmap, window: tuple[int, int, int, int]) -> None:
        """With explore_clear_space, make all but obstacles unknown; write the polygon's edge as obstacles."""
        if self._polygon is None:
            return
        x0, y0, x1, y1 = window
        cells = master.cells[y0:y1, x0:x1]
        if self.options.explore_clear_space:
            cells[cells != LETHAL] = NO_INFORMATION
        for column, row in _edge_cells(master, self._polygon):
            is_within = (column >= x0) & (column < x1) & (row >= y0) & (row < y1)
            master.cells[row[is_within], column[is_within]] = LETHAL


def _edge_cells(costmap: Costmap, polygon: NDArray[np.float64]) -> list[tuple[NDArray[np.int64], NDArray[np.int64]]]:
    """Return columns and rows of the cells along each edge, which touch at sides or corners."""
    corners = costmap.in_cells(polygon)
    edges: list[tuple[NDArray[np.int64], NDArray[np.int64]]] = []
    limit = float(costmap.width + costmap.height)
    for start, end in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        # an edge far outside the costmap is shortened
        start, end = np.clip(start, -limit, 2.0 * limit), np.clip(end, -limit, 2.0 * limit)
        count = 2 * math.ceil(np.abs(end - start).max()) + 2
        points = np.floor(start + (end - start) * np.linspace(0.0, 1.0, count)[:, None]).astype(np.int64)
        edges.append((points[:, 0], points[:, 1]))
    return edges
