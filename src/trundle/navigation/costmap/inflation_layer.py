"""costmap_2d::InflationLayer: costs that fall off with the distance to obstacles."""

import math
from typing import Annotated

import msgspec
import numpy as np
from msgspec import Meta

from trundle.navigation import _grids

from .costmap import FREE_SPACE, INSCRIBED, LETHAL, Bounds, Costmap

_MAX_RADIUS_CELLS = 2000


class InflationSettings(msgspec.Struct, kw_only=True):
    """Parameters, with the original's defaults."""

    enabled: bool = True
    cost_scaling_factor: Annotated[float, Meta(ge=0.0, le=100.0)] = 10.0
    """Exponential rate at which costs fall off [1/m]."""
    inflation_radius: Annotated[float, Meta(ge=0.0, le=50.0)] = 0.55
    """[m]"""
    inflate_unknown: bool = False


def inflated_costs(settings: InflationSettings, resolution_m: float, inscribed_m: float) -> list[int]:
    """Return the cost for each squared distance in cells: lethal, inscribed, then falling exponentially."""
    radius = min(math.ceil(settings.inflation_radius / resolution_m - 1e-9), _MAX_RADIUS_CELLS)
    distances_m = np.sqrt(np.arange(radius * radius + 1)) * resolution_m
    factors = np.exp(np.minimum(-settings.cost_scaling_factor * (distances_m - inscribed_m), 0.0))
    costs = np.where(distances_m <= inscribed_m, INSCRIBED, ((INSCRIBED - 1) * factors).astype(int))
    costs[0] = LETHAL
    return costs.tolist()


class InflationLayer:
    """Inflates the obstacles that the layers below marked."""

    is_current = True

    def __init__(self, name: str, master: Costmap, settings: InflationSettings) -> None:
        self.name = name
        self.options = settings
        self._master = master
        self._inscribed_m = 0.0
        self._last = Bounds()
        self._is_changed = True
        self._costs: list[int] = []

    @property
    def enabled(self) -> bool:
        """True if the layer takes part in updates."""
        return self.options.enabled

    def set_inscribed_radius(self, radius_m: float) -> None:
        """Take the robot's inscribed radius."""
        self._inscribed_m = radius_m
        self.change()

    def change(self) -> None:
        """Compute all costs again at the next update."""
        self._is_changed = True

    def match_size(self) -> None:
        """Compute the costs for a new resolution."""
        self.change()

    def reset(self) -> None:
        """Inflate everywhere at the next update."""
        self.change()

    def update_bounds(self, robot: tuple[float, float, float], bounds: Bounds) -> None:
        """Join the bounds of the last update, and extend both by the inflation radius."""
        del robot
        if self._is_changed:
            self._costs = inflated_costs(self.options, self._master.resolution_m, self._inscribed_m)
            bounds.touch_all(self._master)
            self._is_changed = False
        last, self._last = self._last, Bounds(bounds.min_x, bounds.min_y, bounds.max_x, bounds.max_y)
        bounds.join(last)
        bounds.join(Bounds(bounds.min_x, bounds.min_y, bounds.max_x, bounds.max_y), self.options.inflation_radius)

    def update_costs(self, master: Costmap, window: tuple[int, int, int, int]) -> None:
        """Inflate a window."""
        unknown = self.options.inflate_unknown
        if self._costs and max(self._costs) > FREE_SPACE:
            _grids.inflate(master.cells, window, self._costs, inflate_unknown=unknown)
