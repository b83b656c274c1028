"""costmap_2d::StaticLayer: costs from a map on a topic."""

from typing import TYPE_CHECKING, Annotated

import msgspec
import numpy as np
from msgspec import Meta
from numpy.typing import NDArray

from trundle.gazebo.nodes.rate import LogThrottle
from trundle.ros import Node, TransformBuffer, TransformError
from trundle.spatial import Pose, matrix_from_quaternion

from .costmap import FREE_SPACE, LETHAL, MAX_CELLS, NO_INFORMATION, Bounds, Costmap

if TYPE_CHECKING:
    from trundle.ros.message_types import map_msgs, nav_msgs

_UNKNOWN = -1


class StaticSettings(msgspec.Struct, kw_only=True):
    """Parameters, with the original's defaults."""

    map_topic: str = "map"
    first_map_only: bool = False
    subscribe_to_updates: bool = False
    track_unknown_space: bool = True
    use_maximum: bool = False
    lethal_cost_threshold: Annotated[int, Meta(ge=0, le=100)] = 100
    unknown_cost_value: int = _UNKNOWN
    trinary_costmap: bool = True


class StaticSwitch(msgspec.Struct, kw_only=True):
    """Settings that dynamic_reconfigure changes."""

    enabled: bool = True


def _costs_of_occupancies(settings: StaticSettings) -> NDArray[np.uint8]:
    """Return the cost (256,) of each occupancy, by its bits."""
    occupancy = np.arange(256, dtype=np.uint8).view(np.int8).astype(np.int16)
    threshold = max(min(settings.lethal_cost_threshold, 100), 1)
    scaled = np.zeros_like(occupancy) if settings.trinary_costmap else occupancy * LETHAL // threshold
    costs = np.where(occupancy >= threshold, LETHAL, np.clip(scaled, FREE_SPACE, LETHAL))
    unknown = NO_INFORMATION if settings.track_unknown_space else FREE_SPACE
    is_unknown = np.arange(256) == settings.unknown_cost_value & 255
    return np.where(is_unknown, unknown, costs).astype(np.uint8)


class StaticLayer:
    """Copies the map's costs; in a costmap without a rolling window, the map sets size and resolution."""

    is_current = True

    def __init__(
        self,
        node: Node,
        name: str,
        master: Costmap,
        settings: StaticSettings,
        *,
        frame: str,
        buffer: TransformBuffer,
        is_rolling: bool,
    ) -> None:
        """Subscribe.

        Args:
            node: node of the costmap.
            name: the layer's.
            master: the costmap.
            settings: parameters.
            frame: frame of the costmap; in a rolling window it may differ from the map's.
            buffer: transforms.
            is_rolling: True for a rolling window.
        """
        self.name = name
        self.options = StaticSwitch()
        self._frame = frame
        self._buffer = buffer
        self._warnings = LogThrottle(node, 5.0)
        self._node = node
        self._master = master
        self._settings = settings
        self._cost_of = _costs_of_occupancies(settings)
        self._is_rolling = is_rolling
        self.map: Costmap | None = None
        self._map_frame = "map"
        self._has_changed = False
        self._subscription = node.subscribe(settings.map_topic, "nav_msgs/OccupancyGrid", self._on_map, queue_size=1)
        if settings.subscribe_to_updates:
            kind = "map_msgs/OccupancyGridUpdate"
            node.subscribe(f"{settings.map_topic}_updates", kind, self._on_update, queue_size=10)

    def _costs(self, values: NDArray[np.int8]) -> NDArray[np.uint8]:
        """Return costs of occupancies."""
        return self._cost_of[values.view(np.uint8)]

    def _on_map(self, message: "nav_msgs.OccupancyGrid") -> None:
        info = message.info
        position = info.origin.position
        numbers = np.array([info.resolution, position.x, position.y])
        size = info.width * info.height
        if not np.isfinite(numbers).all() or not info.resolution > 0.0 or size > MAX_CELLS or len(message.data) != size:
            self._node.log.error(
                f"{self.name}: a map of {info.width} x {info.height} cells of {info.resolution:g} m with "
                f"{len(message.data)} values is left out"
            )
            return
        self._node.log.info(f"Received a {info.width} X {info.height} map at {info.resolution:f} m/pix")
        grid = Costmap(info.width, info.height, float(info.resolution), (float(position.x), float(position.y)))
        grid.cells = self._costs(np.asarray(message.data, dtype=np.int8).reshape(info.height, info.width))
        self.map, self._map_frame, self._has_changed = grid, message.header.frame_id.lstrip("/"), True
        if self._settings.first_map_only:
            self._node.log.info("Shutting down the map subscriber. first_map_only flag is on")
            self._subscription.unregister()

    def _on_update(self, message: "map_msgs.OccupancyGridUpdate") -> None:
        x0, y0, width, height = message.x, message.y, message.width, message.height
        grid = self.map
        fits = grid is not None and x0 >= 0 and y0 >= 0 and x0 + width <= grid.width and y0 + height <= grid.height
        if grid is None or not fits or len(message.data) != width * height:
            self._node.log.error(f"{self.name}: a map update outside the map is left out")
            return
        values = np.asarray(message.data, dtype=np.int8).reshape(height, width)
        grid.cells[y0 : y0 + height, x0 : x0 + width] = self._costs(values)
        self._has_changed = True

    @property
    def enabled(self) -> bool:
        """True if the layer takes part in updates."""
        return self.options.enabled

    @property
    def fits(self) -> bool:
        """True if the costmap has the map's size, or rolls."""
        return self.map is None or self._is_rolling or self.map.geometry == self._master.geometry

    def match_size(self) -> None:
        """Give the costmap the map's size, unless it rolls."""
        grid, master = self.map, self._master
        if grid is None or self.fits:
            return
        master.width, master.height, master.resolution_m, master.origin = grid.geometry
        master.clear()

    def change(self) -> None:
        """See `Layer`."""
        self._has_changed = True

    def reset(self) -> None:
        """Draw the whole map at the next update."""
        self._has_changed = True

    def update_bounds(self, robot: tuple[float, float, float], bounds: Bounds) -> None:
        """Extend the bounds to a new map."""
        del robot
        if self.map is not None and (self._has_changed or self._is_rolling):
            bounds.touch_all(self._master if self._is_rolling else self.map)
        self._has_changed = False

    def update_costs(self, master: Costmap, window: tuple[int, int, int, int]) -> None:
        """Copy costs into a window."""
        if self.map is None:
            return
        x0, y0, x1, y1 = window
        target = master.cells[y0:y1, x0:x1]
        is_inside: NDArray[np.bool_] | bool = True
        if self.map.geometry == master.geometry and not self._is_rolling:
            source = self.map.cells[y0:y1, x0:x1]
        else:
            sampled = self._sampled(self.map, master, window)
            if sampled is None:
                return
            source, is_inside = sampled
        if self._settings.use_maximum:
            known = source != NO_INFORMATION
            is_inside = is_inside & known & ((target == NO_INFORMATION) | (source > target))
        np.copyto(target, source, where=is_inside)

    def _sampled(
        self, grid: Costmap, master: Costmap, window: tuple[int, int, int, int]
    ) -> tuple[NDArray[np.uint8], NDArray[np.bool_]] | None:
        """Return the map's costs at the centers of a window's cells, and which of them are on the map.

        None without a transform from the costmap's frame to the map's.
        """
        map_from_costmap = Pose()
        if self._frame != self._map_frame:
            try:
                map_from_costmap = self._buffer.lookup_transform(self._map_frame, self._frame).pose
            except TransformError as error:
                self._warnings.warn(f"{self.name}: no transform from {self._frame} to {self._map_frame}: {error}")
                return None
        x0, y0, x1, y1 = window
        x = (np.arange(x0, x1) + 0.5) * master.resolution_m + master.origin[0]
        y = (np.arange(y0, y1) + 0.5) * master.resolution_m + master.origin[1]
        turned = matrix_from_quaternion(map_from_costmap.quaternion)
        places = [
            turned[axis, 0] * x[None, :] + turned[axis, 1] * y[:, None] + map_from_costmap.position[axis]
            for axis in (0, 1)
        ]
        columns = np.floor((places[0] - grid.origin[0]) / grid.resolution_m).astype(int)
        rows = np.floor((places[1] - grid.origin[1]) / grid.resolution_m).astype(int)
        is_inside = (columns >= 0) & (columns < grid.width) & (rows >= 0) & (rows < grid.height)
        costs = np.full(is_inside.shape, NO_INFORMATION, dtype=np.uint8)
        costs[is_inside] = grid.cells[rows[is_inside], columns[is_inside]]
        return costs, is_inside
