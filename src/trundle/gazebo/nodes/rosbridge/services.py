"""Services: calls by clients, and services provided by clients."""

import asyncio
import itertools
from collections.abc import Callable, Mapping
from typing import Any, cast

from trundle.ros import MasterError, Message, Node, Service, ServiceError, probe_service

from .errors import NoServiceError, RosbridgeError
from .json_values import JsonDecoder, JsonEncoder

_MAX_PENDING = 1000


async def call_service(node: Node, encoder: JsonEncoder, name: str, arguments: object) -> dict[str, object]:
    """Call a service, and return the fields of its response.

    Args:
        node: node that calls.
        encoder: encoder of the response.
        name: service's name.
        arguments: fields by name or in order; any other value means no fields.

    Raises:
        RosbridgeError: no such service, or arguments that do not match its type.
        RosError: the call fails.
    """
    service = node.resolve(name)
    try:
        uri = str(await node.master.call("lookupService", service))
    except MasterError:
        raise NoServiceError(service) from None
    header = await probe_service(uri, service, node.name)
    kind = node.messages.service(header.get("type", ""))
    fields = request_fields(node, kind.request, arguments)
    response = await node.call_service(service, kind.type, fields, timeout_s=None)
    return encoder.values(response, kind.response)


def request_fields(node: Node, type_name: str, arguments: object) -> dict[str, object]:
    """Return the fields of a request.

    Raises:
        RosbridgeError: the arguments do not match the type.
    """
    values: object = arguments if isinstance(arguments, Mapping) else {}
    if isinstance(arguments, list):
        values = dict(zip(node.messages.fields(type_name), cast("list[object]", arguments), strict=False))
    return JsonDecoder(node.messages).fields(values, type_name, node.clock.now_ns())


class ClientService:
    """A service provided by a client."""

    _numbers = itertools.count(1)

    def __init__(
        self, node: Node, name: str, type_name: str, encoder: JsonEncoder, send: Callable[[dict[str, object]], None]
    ) -> None:
        self._node = node
        self._name = name
        self._encoder = encoder
        self._send = send
        self._kind = node.messages.service(type_name)
        self._pending: dict[str, asyncio.Future[dict[str, Any]]] = {}
        self._service: Service = node.advertise_service(name, type_name, self._answer)

    def respond(self, key: object, values: object) -> None:
        """Forward the client's response to a request.

        Raises:
            RosbridgeError: the response does not match the type.
        """
        fields = JsonDecoder(self._node.messages).fields(values, self._kind.response, self._node.clock.now_ns())
        self._node.messages.new(self._kind.response, fields)  # raises if the response is invalid
        pending = self._pending.get(str(key))
        if pending is None or pending.done():
            raise RosbridgeError(f"Service {self._name} has no request {str(key)[:100]!r}")
        pending.set_result(fields)

    def close(self) -> None:
        """Unadvertise; calls in progress fail."""
        self._service.unregister()
        for pending in self._pending.values():
            if not pending.done():
                pending.set_exception(ServiceError(f"Service {self._name} was unadvertised with a call in progress"))

    async def _answer(self, request: Message) -> dict[str, Any]:
        if len(self._pending) >= _MAX_PENDING:
            raise ServiceError(f"{self._name}: {_MAX_PENDING} calls are waiting for the client already")
        key = f"service_request:{self._name}:{next(self._numbers)}"
        pending = self._pending[key] = asyncio.get_running_loop().create_future()
        try:
            arguments = self._encoder.values(request, self._kind.request)
            self._send({"op": "call_service", "id": key, "service": self._name, "args": arguments})
            return await pending
        finally:
            del self._pending[key]
