from .cartographer import CartographerNode as CartographerNode
from .cartographer_grid import CartographerOccupancyGridNode as CartographerOccupancyGridNode
from .gmapping import SlamGmapping as SlamGmapping
from .hector import HectorMapping as HectorMapping
from .karto import SlamKarto as SlamKarto
from .slam_toolbox import (
    AsyncSlamToolbox as AsyncSlamToolbox,
    LocalizationSlamToolbox as LocalizationSlamToolbox,
    SyncSlamToolbox as SyncSlamToolbox,
)
