"""global_planner/GlobalPlanner: the path of least cost, with other costs than navfn's."""

import msgspec
import numpy as np
from numpy.typing import NDArray

from trundle.robots.parameters import RosParameters
from trundle.ros import Node

from ..costmap import NO_INFORMATION, CostmapRos
from ..settings import read_settings
from .potential import PotentialPlanner


class GlobalPlannerSettings(msgspec.Struct, kw_only=True):
    """Parameters, with the original's defaults."""

    allow_unknown: bool = True
    default_tolerance: float = 0.0
    lethal_cost: int = 253
    neutral_cost: int = 50
    cost_factor: float = 3.0


class GlobalPlanner(PotentialPlanner):
    """Plans with global_planner's costs; use_dijkstra, use_quadratic and use_grid_path have no effect."""

    def __init__(self, node: Node, name: str, settings: RosParameters, costmap: CostmapRos) -> None:
        own = read_settings(GlobalPlannerSettings, settings)
        super().__init__(node, name, costmap, crossing=_crossing_costs(own), tolerance_m=own.default_tolerance)


def _crossing_costs(settings: GlobalPlannerSettings) -> NDArray[np.float32]:
    """Return the cost of crossing a cell for each cost of a costmap: factor · cost + neutral, below lethal."""
    costs = np.arange(256.0)
    highest = max(settings.lethal_cost - 1.0, 1.0)
    crossing = np.clip(settings.cost_factor * costs + settings.neutral_cost, 1.0, highest)
    crossing[costs >= highest] = 0.0
    crossing[NO_INFORMATION] = highest if settings.allow_unknown else 0.0
    return crossing.astype(np.float32)
