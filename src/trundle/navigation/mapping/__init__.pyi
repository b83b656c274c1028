from .gmapping import SlamGmapping as SlamGmapping
