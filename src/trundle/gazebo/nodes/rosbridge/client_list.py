"""Topics about the connected clients."""

from trundle.ros import Node


class ClientList:
    """Publishes client_count and connected_clients."""

    def __init__(self, node: Node) -> None:
        self._node = node
        self._count = node.advertise("client_count", "std_msgs/Int32", latch=True)
        self._list = node.advertise("connected_clients", "rosbridge_msgs/ConnectedClients", latch=True)
        self._clients: dict[int, dict[str, object]] = {}
        self._publish()

    def add(self, number: int, address: str) -> None:
        """Add a client."""
        self._clients[number] = {"ip_address": address, "connection_time": self._node.clock.now_ns()}
        self._publish()
        self._node.log.info(f"Client connected.  {len(self._clients)} clients total.")

    def remove(self, number: int) -> None:
        """Remove a client."""
        self._clients.pop(number, None)
        self._publish()
        self._node.log.info(f"Client disconnected. {len(self._clients)} clients total.")

    def _publish(self) -> None:
        self._count.publish({"data": len(self._clients)})
        self._list.publish({"clients": list(self._clients.values())})
