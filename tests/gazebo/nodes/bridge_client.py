"""A client of rosbridge, as a web page uses it."""

import json
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from tests.gazebo.nodes.conftest import PATIENCE_S, NodeGraph
from websockets.sync.client import ClientConnection, connect
from websockets.typing import Origin


class BridgeClient:
    """Sends operations and receives messages."""

    def __init__(self, socket: ClientConnection) -> None:
        self.socket = socket

    def send(self, op: str, **fields: Any) -> None:
        """Send an operation."""
        self.socket.send(json.dumps({"op": op, **fields}))

    def receive(self) -> dict[str, Any]:
        """Wait for a JSON message."""
        return json.loads(self.receive_raw())

    def receive_raw(self) -> str | bytes:
        """Wait for a message."""
        return self.socket.recv(PATIENCE_S)

    def receive_json_or_bytes(self) -> dict[str, Any]:
        """Wait for a message; a binary one gives an empty dict."""
        message = self.receive_raw()
        return json.loads(message) if isinstance(message, str) else {}

    def call(self, service: str, args: Any = None) -> Any:
        """Call a service, and return its values."""
        self.send("call_service", service=service, args=args or {})
        response = self.receive()
        assert response["op"] == "service_response", response
        assert response["result"], response
        return response["values"]


def port_of(graph: NodeGraph, node: str) -> int:
    """Wait for the port of a server."""
    ports: list[int] = []

    def is_set() -> bool:
        ports[:] = [graph.loop.run(graph.client.params.get(f"/{node}/actual_port", 0))]
        return bool(ports[0])

    graph.until(is_set)
    return ports[0]


@contextmanager
def connected(port: int, *, origin: str | None = None, path: str = "/") -> Iterator[BridgeClient]:
    """Connect to a server on this machine."""
    with connect(
        f"ws://127.0.0.1:{port}{path}",
        origin=Origin(origin) if origin else None,
        max_size=None,
        open_timeout=PATIENCE_S,
        proxy=None,
    ) as socket:
        assert isinstance(socket, ClientConnection)
        yield BridgeClient(socket)
