"""navfn/NavfnROS: the path of least cost through a costmap."""

import msgspec
import numpy as np
from numpy.typing import NDArray

from trundle.robots.parameters import RosParameters
from trundle.ros import Node

from ..costmap import INSCRIBED, LETHAL, NO_INFORMATION, CostmapRos
from ..settings import read_settings
from .potential import PotentialPlanner

_NEUTRAL_COST, _COST_FACTOR, _OBSTACLE_COST = 50.0, 0.8, 254.0
"""Cost of crossing a cell: navfn's sum of a constant and a share of the costmap's cost."""


class NavfnSettings(msgspec.Struct, kw_only=True):
    """Parameters, with the original's defaults."""

    allow_unknown: bool = True
    default_tolerance: float = 0.0
    visualize_potential: bool = False
    planner_window_x: float = 0.0
    planner_window_y: float = 0.0


class NavfnROS(PotentialPlanner):
    """Plans with navfn's costs."""

    def __init__(self, node: Node, name: str, settings: RosParameters, costmap: CostmapRos) -> None:
        own = read_settings(NavfnSettings, settings)
        crossing = crossing_costs(allow_unknown=own.allow_unknown)
        super().__init__(node, name, costmap, crossing=crossing, tolerance_m=own.default_tolerance)


def crossing_costs(*, allow_unknown: bool) -> NDArray[np.float32]:
    """Return the cost of crossing a cell for each cost of a costmap; 0: impassable."""
    costs = _NEUTRAL_COST + _COST_FACTOR * np.arange(256.0)
    costs[INSCRIBED] = costs[LETHAL] = 0.0
    costs[NO_INFORMATION] = _OBSTACLE_COST - 1.0 if allow_unknown else 0.0
    return costs.astype(np.float32)
