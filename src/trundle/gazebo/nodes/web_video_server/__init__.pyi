from .node import WebVideoServer as WebVideoServer
