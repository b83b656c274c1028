"""costmap_2d::VoxelLayer: obstacles in levels of height, projected onto the costmap."""

from collections.abc import Sequence
from typing import Annotated, Any

import numpy as np
from msgspec import Meta
from numpy.typing import NDArray

from trundle.navigation import _grids
from trundle.ros import Node

from .costmap import LETHAL, Bounds, Costmap, moved
from .observations import Observation, ObservationSource
from .obstacle_layer import ObstacleLayer, ObstacleSettings

_LEVELS = 16
"""Bits of a column for its levels that are unknown or occupied; 16 more follow for those that are occupied."""
_UNKNOWN = (1 << _LEVELS) - 1


class VoxelSettings(ObstacleSettings, kw_only=True):
    """Parameters, with the original's defaults."""

    origin_z: float = 0.0
    """Height of the lowest level [m]."""
    z_resolution: Annotated[float, Meta(ge=0.0, le=50.0)] = 0.2
    """Height of a level [m]."""
    z_voxels: Annotated[int, Meta(ge=0, le=_LEVELS)] = 10
    unknown_threshold: Annotated[int, Meta(ge=0, le=_LEVELS)] = 15
    """Maximum number of unknown levels in a known column."""
    mark_threshold: Annotated[int, Meta(ge=0, le=_LEVELS)] = 0
    """Maximum number of occupied levels in a free column."""


class VoxelLayer(ObstacleLayer):
    """Frees the voxels along the rays to observed points, then marks the voxels of points within obstacle_range.

    A column with more than mark_threshold occupied voxels is an obstacle. Another column is unknown with more than
    unknown_threshold unknown voxels, else free.
    """

    def __init__(
        self,
        node: Node,
        name: str,
        master: Costmap,
        settings: VoxelSettings,
        sources: Sequence[ObservationSource],
        *,
        is_rolling: bool,
        tracks_unknown: bool,
        frame: str,
        topic: str | None,
    ) -> None:
        """See `ObstacleLayer`.

        Args:
            node: node of the costmap.
            name: the layer's.
            master: the costmap.
            settings: parameters.
            sources: sources of observations.
            is_rolling: True for a rolling window.
            tracks_unknown: True: unknown where nothing was seen.
            frame: frame of the costmap.
            topic: topic of the voxels as costmap_2d/VoxelGrid; None: not published.
        """
        super().__init__(node, name, master, settings, sources, is_rolling=is_rolling, tracks_unknown=tracks_unknown)
        self._columns = settings
        self._node = node
        self._frame = frame
        self._publisher = None if topic is None else node.advertise(topic, "costmap_2d/VoxelGrid", queue_size=1)
        self._forget()

    def _forget(self) -> None:
        super()._forget()
        self._voxels = np.full((self._grid.height, self._grid.width), _UNKNOWN, dtype=np.uint32)

    def _roll(self) -> tuple[int, int]:
        columns, rows = super()._roll()
        self._voxels = moved(self._voxels, columns, rows, _UNKNOWN)
        return columns, rows

    def clear_outside(self, x: float, y: float, size_m: float, *, invert: bool) -> Bounds:
        """See `ObstacleLayer`."""
        bounds = super().clear_outside(x, y, size_m, invert=invert)
        self._voxels[self._grid.cells == self._grid.default] = _UNKNOWN
        return bounds

    def update_bounds(self, robot: tuple[float, float, float], bounds: Bounds) -> None:
        """Clear and mark by the latest observations; publish the voxels."""
        super().update_bounds(robot, bounds)
        if self._publisher is not None and self._publisher.has_subscribers:
            self._publisher.publish(self._message())

    def _heights(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the levels of points (n, 3) [m]; the lowest one reaches from 0 to 1."""
        return (points[:, 2] - self._columns.origin_z) / max(self._columns.z_resolution, 1e-3)

    def _clear(self, observation: Observation, range_m: float, bounds: Bounds) -> None:
        sensor = np.array([observation.sensor])
        x, y, z = (*self._grid.in_cells(sensor[:, :2])[0].tolist(), float(self._heights(sensor)[0]))
        if self._grid.cell(*observation.sensor[:2]) is None or not 0.0 <= z < self._columns.z_voxels:
            self._warn_of_sensor(observation)
            return
        offsets = observation.points - sensor
        lengths = np.maximum(np.linalg.norm(offsets, axis=1), 1e-9)
        ends = sensor + offsets * np.minimum(1.0, range_m / lengths)[:, None]
        cells = np.column_stack([self._grid.in_cells(ends[:, :2]), self._heights(ends)])
        settings = self._columns
        _grids.clear_voxel_rays(
            self._voxels,
            self._grid.cells,
            (x, y, z),
            cells,
            levels=settings.z_voxels,
            unknown_threshold=settings.unknown_threshold + _LEVELS - settings.z_voxels,
            mark_threshold=settings.mark_threshold,
        )
        bounds.touch(np.vstack([ends[:, :2], sensor[:, :2]]))

    def _mark(self, observation: Observation, range_m: float, bounds: Bounds) -> None:
        points = self._near(observation, range_m)
        levels = np.maximum(np.floor(self._heights(points)), 0.0)  # points below the lowest level count in it
        points, levels = points[levels < self._columns.z_voxels], levels[levels < self._columns.z_voxels]
        columns, rows, is_inside = self._inside(points)
        bits = np.left_shift(np.uint32(1 | 1 << _LEVELS), levels[is_inside].astype(np.uint32))
        np.bitwise_or.at(self._voxels, (rows, columns), bits)
        counts = np.bitwise_count(self._voxels[rows, columns] >> np.uint32(_LEVELS))
        is_obstacle = counts > self._columns.mark_threshold
        self._grid.cells[rows[is_obstacle], columns[is_obstacle]] = LETHAL
        bounds.touch(points[is_inside, :2][is_obstacle])

    def _message(self) -> dict[str, Any]:
        grid, (x, y) = self._grid, self._grid.origin
        return {
            "header": {"stamp": self._node.clock.now_ns(), "frame_id": self._frame},
            "data": self._voxels.reshape(-1),
            "origin": {"x": x, "y": y, "z": self._columns.origin_z},
            "resolutions": {"x": grid.resolution_m, "y": grid.resolution_m, "z": self._columns.z_resolution},
            "size_x": grid.width,
            "size_y": grid.height,
            "size_z": self._columns.z_voxels,
        }


class NonPersistentVoxelLayer(VoxelLayer):
    """nonpersistent_voxel_layer's: a voxel layer that forgets everything before each update."""

    def update_bounds(self, robot: tuple[float, float, float], bounds: Bounds) -> None:
        """See `VoxelLayer`."""
        bounds.touch_all(self._grid)
        self._forget()
        super().update_bounds(robot, bounds)
