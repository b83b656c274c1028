from .bounded_explore_layer import BoundedExploreLayer as BoundedExploreLayer
from .costmap import (
    FREE_SPACE as FREE_SPACE,
    INSCRIBED as INSCRIBED,
    LETHAL as LETHAL,
    MAX_CELLS as MAX_CELLS,
    NO_INFORMATION as NO_INFORMATION,
    Bounds as Bounds,
    Costmap as Costmap,
)
from .costmap_ros import CostmapRos as CostmapRos, CostmapSettings as CostmapSettings
from .footprint import circle as circle, placed as placed, radii as radii
from .plugin import LayerPlugin as LayerPlugin
