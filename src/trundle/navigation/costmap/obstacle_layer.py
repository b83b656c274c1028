"""costmap_2d::ObstacleLayer: obstacles marked at the points that sensors measure, and cleared along their rays."""

from collections.abc import Sequence
from typing import Annotated

import msgspec
import numpy as np
from msgspec import Meta
from numpy.typing import NDArray

from trundle.gazebo.nodes.rate import LogThrottle
from trundle.navigation import _grids
from trundle.ros import Node

from .costmap import FREE_SPACE, LETHAL, NO_INFORMATION, Bounds, Costmap
from .footprint import placed
from .observations import Observation, ObservationSource

_OVERWRITE, _MAXIMUM = 0, 1


class ObstacleSettings(msgspec.Struct, kw_only=True):
    """Parameters, with the original's defaults."""

    enabled: bool = True
    footprint_clearing_enabled: bool = True
    max_obstacle_height: Annotated[float, Meta(ge=0.0, le=50.0)] = 2.0
    combination_method: Annotated[int, Meta(ge=0, le=2)] = _MAXIMUM


class ObstacleLayer:
    """Frees the cells along the rays to observed points, then marks the cells of points within obstacle_range."""

    def __init__(
        self,
        node: Node,
        name: str,
        master: Costmap,
        settings: ObstacleSettings,
        sources: Sequence[ObservationSource],
        *,
        is_rolling: bool,
        tracks_unknown: bool,
    ) -> None:
        self.name = name
        self.options = settings
        self.footprint = np.empty((0, 2))
        """Polygon (n, 2) in the robot's frame [m], whose cells are freed."""
        self._master = master
        self._sources = sources
        self._is_rolling = is_rolling
        default = NO_INFORMATION if tracks_unknown else FREE_SPACE
        self._grid = Costmap(master.width, master.height, master.resolution_m, master.origin, default)
        self._warnings = LogThrottle(node, 1.0)
        self._robot = (0.0, 0.0, 0.0)

    @property
    def enabled(self) -> bool:
        """True if the layer takes part in updates."""
        return self.options.enabled

    @property
    def is_current(self) -> bool:
        """True if every sensor's last message came within its expected time."""
        return all(source.is_current for source in self._sources)

    def change(self) -> None:
        """See `Layer`; forgets obstacles."""
        self._forget()

    def match_size(self) -> None:
        """Take the costmap's size; forgets obstacles."""
        grid, master = self._grid, self._master
        grid.width, grid.height, grid.resolution_m, grid.origin = master.geometry
        self._forget()

    def _forget(self) -> None:
        self._grid.clear()

    def _roll(self) -> tuple[int, int]:
        """Move the origin to the costmap's; returns the numbers of columns and rows of the move."""
        return self._grid.shift_to(*self._master.origin)

    def reset(self) -> None:
        """Forget obstacles."""
        self._forget()
        for source in self._sources:
            source.clear()

    def clear_outside(self, x: float, y: float, size_m: float, *, invert: bool) -> Bounds:
        """Forget obstacles outside a square around a point [m], or with `invert` inside; returns changed bounds."""
        grid = self._grid
        bounds = Bounds(x - size_m / 2.0, y - size_m / 2.0, x + size_m / 2.0, y + size_m / 2.0)
        x0, y0, x1, y1 = bounds.window(grid)
        if invert:
            grid.cells[y0:y1, x0:x1] = grid.default
            return bounds
        kept = grid.cells[y0:y1, x0:x1].copy()
        grid.clear()
        grid.cells[y0:y1, x0:x1] = kept
        whole = Bounds()
        whole.touch_all(grid)
        return whole

    def update_bounds(self, robot: tuple[float, float, float], bounds: Bounds) -> None:
        """Clear and mark by the latest observations."""
        self._robot = robot
        if self._is_rolling:
            self._roll()
        seen = [(source, source.observations()) for source in self._sources]
        for source, observations in seen:
            for observation in observations if source.settings.clearing else ():
                self._clear(observation, source.settings.raytrace_range, bounds)
        for source, observations in seen:
            for observation in observations if source.settings.marking else ():
                self._mark(observation, source.settings.obstacle_range, bounds)
        if self.options.footprint_clearing_enabled and len(self.footprint):
            bounds.touch(placed(self.footprint, *robot))

    def _clear(self, observation: Observation, range_m: float, bounds: Bounds) -> None:
        x, y, _ = observation.sensor
        if self._grid.cell(x, y) is None:
            self._warn_of_sensor(observation)
            return
        ends = observation.points[:, :2]
        sensor = self._grid.in_cells(np.array([[x, y]]))[0]
        resolution = self._grid.resolution_m
        _grids.clear_rays(
            self._grid.cells, (sensor[0], sensor[1]), self._grid.in_cells(ends), range=range_m / resolution
        )
        offsets = ends - np.array([x, y])
        lengths = np.maximum(np.hypot(*offsets.T), 1e-9)
        bounds.touch(np.array([x, y]) + offsets * np.minimum(1.0, range_m / lengths)[:, None])
        bounds.touch(np.array([[x, y]]))

    def _warn_of_sensor(self, observation: Observation) -> None:
        place = ", ".join(f"{value:.2f}" for value in observation.sensor)
        self._warnings.warn(
            f"The origin for the sensor at ({place}) is out of map bounds. So, the costmap cannot raytrace for it."
        )

    def _near(self, observation: Observation, range_m: float) -> NDArray[np.float64]:
        """Return the points (n, 3) that mark obstacles: within max_obstacle_height and the range [m]."""
        points = observation.points[observation.points[:, 2] <= self.options.max_obstacle_height]
        offsets = points - np.array(observation.sensor)
        return points[(offsets**2).sum(axis=1) < range_m**2]

    def _inside(self, points: NDArray[np.float64]) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.bool_]]:
        """Return columns and rows of the points (n, 3) that are in the costmap, and a mask (n,) of these points."""
        cells = np.floor(self._grid.in_cells(points[:, :2])).astype(int)
        is_inside = np.all((cells >= 0) & (cells < np.array([self._grid.width, self._grid.height])), axis=1)
        columns, rows = cells[is_inside].T
        return columns, rows, is_inside

    def _mark(self, observation: Observation, range_m: float, bounds: Bounds) -> None:
        points = self._near(observation, range_m)
        columns, rows, is_inside = self._inside(points)
        self._grid.cells[rows, columns] = LETHAL
        bounds.touch(points[is_inside, :2])

    def update_costs(self, master: Costmap, window: tuple[int, int, int, int]) -> None:
        """Copy obstacles into a window."""
        if self.options.footprint_clearing_enabled and len(self.footprint):
            _free_polygon(self._grid, placed(self.footprint, *self._robot))
        x0, y0, x1, y1 = window
        source, target = self._grid.cells[y0:y1, x0:x1], master.cells[y0:y1, x0:x1]
        known = source != NO_INFORMATION
        match self.options.combination_method:
            case 0:
                np.copyto(target, source, where=known)
            case 1:
                np.copyto(target, source, where=known & ((target == NO_INFORMATION) | (source > target)))
            case _:
                pass  # the original writes no obstacles either


def _free_polygon(grid: Costmap, corners: NDArray[np.float64]) -> None:
    """Free the cells whose centers are in a convex polygon, or within half a cell of it."""
    bounds = Bounds()
    bounds.touch(corners)
    x0, y0, x1, y1 = bounds.window(grid)
    if x0 >= x1 or y0 >= y1:
        return
    x, y = np.meshgrid(*(np.arange(low, high) + 0.5 for low, high in ((x0, x1), (y0, y1))))
    points, following = grid.in_cells(corners), np.roll(grid.in_cells(corners), -1, axis=0)
    area = float(np.sum(points[:, 0] * following[:, 1] - points[:, 1] * following[:, 0]))
    is_inside = np.ones(x.shape, dtype=bool)
    for (ax, ay), (bx, by) in zip(points.tolist(), following.tolist(), strict=True):
        length = max(float(np.hypot(bx - ax, by - ay)), 1e-9)
        left = ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / length
        is_inside &= left * (1.0 if area > 0.0 else -1.0) >= -0.5
    grid.cells[y0:y1, x0:x1][is_inside] = FREE_SPACE
