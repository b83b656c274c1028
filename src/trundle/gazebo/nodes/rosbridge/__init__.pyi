from .tcp import RosbridgeTcp as RosbridgeTcp
from .websocket import RosbridgeWebsocket as RosbridgeWebsocket
