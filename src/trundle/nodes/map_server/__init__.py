"""map_server's two nodes: a map from a picture onto /map, and from /map into a picture."""

from .saver import MapSaver
from .server import MapServer

__all__ = ["MapSaver", "MapServer"]
