"""XML-RPC clients, where programs import them from."""

from .server_proxy import ServerProxy as ServerProxy
