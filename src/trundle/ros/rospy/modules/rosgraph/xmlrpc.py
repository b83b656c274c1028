"""XML-RPC clients, at the path that programs import them from."""

from .server_proxy import ServerProxy as ServerProxy
