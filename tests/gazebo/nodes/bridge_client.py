"""A client of rosbridge, as a web page has one."""

import json
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from tests.gazebo.nodes.conftest import PATIENCE_S, Stage
from websockets.sync.client import ClientConnection, connect


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
        """Wait for a message; one of bytes is empty."""
        message = self.receive_raw()
        return json.loads(message) if isinstance(message, str) else {}

    def call(self, service: str, args: Any = None) -> Any:
        """Call a service, and return its values."""
        self.send("call_service", service=service, args=args or {})
        answer = self.receive()
        assert answer["op"] == "service_response", answer
        assert answer["result"], answer
        return answer["values"]


def port_of(stage: Stage, node: str) -> int:
    """Wait for the port of a server."""
    ports: list[int] = []

    def asked() -> bool:
        ports[:] = [stage.loop.run(stage.client.params.get(f"/{node}/actual_port", 0))]
        return bool(ports[0])

    stage.until(asked)
    return ports[0]


@contextmanager
def connected(port: int, *, origin: str | None = None, path: str = "/") -> Iterator[BridgeClient]:
    """Connect to a server of this machine."""
    with connect(
        f"ws://127.0.0.1:{port}{path}",
        origin=origin,
        max_size=None,
        open_timeout=PATIENCE_S,
        proxy=None,  # pyright: ignore[reportArgumentType]
    ) as socket:
        yield BridgeClient(socket)
