from .gmapping import SlamGmapping as SlamGmapping
from .hector import HectorMapping as HectorMapping
