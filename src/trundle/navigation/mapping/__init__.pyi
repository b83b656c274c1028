from .cartographer_node import CartographerNode as CartographerNode
from .cartographer_occupancy_grid_node import CartographerOccupancyGridNode as CartographerOccupancyGridNode
from .hector_mapping import HectorMapping as HectorMapping
from .slam_gmapping import SlamGmapping as SlamGmapping
from .slam_karto import SlamKarto as SlamKarto
from .slam_toolbox import (
    AsyncSlamToolbox as AsyncSlamToolbox,
    LocalizationSlamToolbox as LocalizationSlamToolbox,
    SyncSlamToolbox as SyncSlamToolbox,
)
