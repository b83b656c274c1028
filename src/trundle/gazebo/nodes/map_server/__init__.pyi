from .saver import MapSaver as MapSaver
from .server import MapServer as MapServer
