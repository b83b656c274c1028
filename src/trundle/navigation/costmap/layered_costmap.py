"""Layers over one costmap, updated together."""

from collections.abc import Sequence
from typing import Protocol

import msgspec
from numpy import float64
from numpy.typing import NDArray

from .costmap import FREE_SPACE, NO_INFORMATION, Bounds, Costmap
from .footprint import radii
from .inflation_layer import InflationLayer
from .obstacle_layer import ObstacleLayer


class Layer(Protocol):
    """One layer of a costmap."""

    name: str

    @property
    def options(self) -> msgspec.Struct:
        """Settings that dynamic_reconfigure changes."""
        ...

    def change(self) -> None:
        """Take changed options."""
        ...

    @property
    def enabled(self) -> bool:
        """True if the layer takes part in updates."""
        ...

    @property
    def is_current(self) -> bool:
        """True if the data of the layer's sensors are recent enough."""
        ...

    def match_size(self) -> None:
        """Take the costmap's size and resolution."""
        ...

    def reset(self) -> None:
        """Discard all observations."""
        ...

    def update_bounds(self, robot: tuple[float, float, float], bounds: Bounds) -> None:
        """Extend the bounds to the cells that will change, with the robot at x, y [m] and yaw [rad]."""
        ...

    def update_costs(self, master: Costmap, window: tuple[int, int, int, int]) -> None:
        """Write costs into the window x0, y0, x1, y1."""
        ...


class LayeredCostmap:
    """A costmap and its layers, the first one at the bottom."""

    def __init__(self, costmap: Costmap, *, is_rolling: bool, tracks_unknown: bool) -> None:
        self.costmap = costmap
        costmap.default = NO_INFORMATION if tracks_unknown else FREE_SPACE
        costmap.clear()
        self.layers: Sequence[Layer] = ()
        self._is_rolling = is_rolling
        self._cleared = Bounds()
        self.changed = (0, 0, 0, 0)
        """Window of the last update: x0, y0, x1, y1."""

    def set_footprint(self, footprint: NDArray[float64]) -> None:
        """Give the layers the robot's padded outline (n, 2) [m]."""
        inscribed_m, _ = radii(footprint)
        for layer in self.layers:
            if isinstance(layer, InflationLayer):
                layer.set_inscribed_radius(inscribed_m)
            elif isinstance(layer, ObstacleLayer):
                layer.footprint = footprint

    @property
    def is_current(self) -> bool:
        """True if the data of all layers' sensors are recent enough."""
        return all(layer.is_current for layer in self.layers if layer.enabled)

    def match_size(self) -> None:
        """Give the layers the costmap's size."""
        geometry = self.costmap.geometry
        for layer in self.layers:
            layer.match_size()
        if self.costmap.geometry != geometry:  # a static layer below has set the size from its map
            for layer in self.layers:
                layer.match_size()

    def reset(self) -> None:
        """Forget all observations."""
        self.costmap.clear()
        for layer in self.layers:
            layer.reset()

    def clear_outside(self, x: float, y: float, size_m: float, names: Sequence[str], *, invert: bool) -> None:
        """Forget the obstacles of some layers outside a square around a point [m]; with `invert`, those inside it."""
        for layer in self.layers:
            if isinstance(layer, ObstacleLayer) and layer.name in names:
                self._cleared.join(layer.clear_outside(x, y, size_m, invert=invert))

    def update(self, robot: tuple[float, float, float]) -> None:
        """Update the costs, with the robot at x, y [m] and yaw [rad]."""
        costmap = self.costmap
        if self._is_rolling:
            half = 0.5 * costmap.resolution_m
            costmap.shift_to(robot[0] - costmap.width * half, robot[1] - costmap.height * half)
        layers = [layer for layer in self.layers if layer.enabled]
        bounds, self._cleared = self._cleared, Bounds()
        for layer in layers:
            layer.update_bounds(robot, bounds)
        self.changed = x0, y0, x1, y1 = bounds.window(costmap)
        if x0 >= x1 or y0 >= y1:
            return
        costmap.cells[y0:y1, x0:x1] = costmap.default
        for layer in layers:
            layer.update_costs(costmap, self.changed)
