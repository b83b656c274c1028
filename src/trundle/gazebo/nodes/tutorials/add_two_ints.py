"""Servers and clients of the service `add_two_ints`, of rospy_tutorials and roscpp_tutorials."""

from typing import Any

from trundle.ros import Node, ServiceError

from ..host import NodeHost

_SERVICE = "add_two_ints"
_DEFAULTS = ("1", "3")


class AddTwoIntsServer:
    """rospy_tutorials/add_two_ints_server."""

    kind = "rospy_tutorials/AddTwoInts"

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node

    async def run(self) -> int:
        """Serve until cancelled."""
        self._node.advertise_service(_SERVICE, self.kind, self._add)
        self._node.log.info("Ready to add two ints.")
        await self._node.closed.wait()
        return 0

    def _add(self, request: Any) -> dict[str, Any]:
        total = request.a + request.b
        self._node.log.info(f"Returning [{request.a} + {request.b} = {total}]")
        return {"sum": total}


class CppAddTwoIntsServer(AddTwoIntsServer):
    """roscpp_tutorials/add_two_ints_server."""

    kind = "roscpp_tutorials/TwoInts"

    def _add(self, request: Any) -> dict[str, Any]:
        total = request.a + request.b
        self._node.log.info(f"request: x={request.a}, y={request.b}")
        self._node.log.info(f"  sending back response: [{total}]")
        return {"sum": total}


class AddTwoIntsClient:
    """rospy_tutorials/add_two_ints_client: adds the two numbers in its arguments, by default 1 and 3."""

    kind = "rospy_tutorials/AddTwoInts"

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del host
        self._node = node
        self._arguments = arguments

    async def run(self) -> int:
        """Call once; return 1 if the call fails or an argument is not a number."""
        node = self._node
        try:
            a, b = (int(word) for word in self._arguments or _DEFAULTS)
        except ValueError:
            node.log.error("usage: add_two_ints_client X Y")
            return 1
        try:
            await node.wait_for_service(_SERVICE)
            response = await node.call_service(_SERVICE, self.kind, {"a": a, "b": b})
        except ServiceError as error:
            node.log.error(f"Failed to call service {_SERVICE}: {error}")
            return 1
        self._print(a, b, response)
        return 0

    def _print(self, a: int, b: int, response: Any) -> None:
        self._node.log.info(f"{a} + {b} = {response.sum}")


class CppAddTwoIntsClient(AddTwoIntsClient):
    """roscpp_tutorials/add_two_ints_client."""

    kind = "roscpp_tutorials/TwoInts"

    def _print(self, a: int, b: int, response: Any) -> None:
        del a, b
        self._node.log.info(f"Sum: {response.sum}")
