"""The graph's services: advertised with their types, called with clients' bytes."""

import asyncio
import itertools
from dataclasses import dataclass

from trundle.ros import MessageError, Node, RosError, ServiceType, call_service_bytes, probe_service

from ..clients.connection import Connection
from ..clients.hub import Hub
from ..clients.protocol import ENCODING, SERVICE_HEADER, WARNING, service_header
from ..clients.server_messages import (
    AdvertiseServices,
    ServiceCallFailure,
    ServiceOffer,
    ServiceSchema,
    UnadvertiseServices,
)
from .master_state import MasterState

MAX_IN_FLIGHT = 64
"""Limit of one client's pending calls."""
_MAX_PROBES = 8
"""Limit of providers probed at the same time."""
_ATTEMPTS = 5
_LOGGERS = {"get_loggers": "roscpp/GetLoggers", "set_logger_level": "roscpp/SetLoggerLevel"}
"""Types of the services of every node."""


@dataclass(frozen=True, slots=True, kw_only=True)
class _Service:
    id: int
    name: str
    kind: ServiceType
    offer: ServiceOffer


class ServiceTable:
    """Services with unique ids."""

    def __init__(self, hub: Hub) -> None:
        self._hub = hub
        self._ids = itertools.count(1)
        self._services: dict[str, _Service] = {}
        self._providers: dict[str, tuple[str, ...]] = {}
        """Service → providers, for all probed services, whether or not their type is known."""
        self._failures: dict[str, int] = {}
        """Service → number of failed probes."""
        self._calls: dict[Connection, set[asyncio.Task[None]]] = {}

    def offer(self, client: Connection) -> None:
        """Advertise all services to a new client."""
        if self._services:
            client.send(AdvertiseServices(tuple(service.offer for service in self._services.values())))

    async def update(self, node: Node, state: MasterState) -> None:
        """Advertise new services and unadvertise removed ones."""
        new = {name: nodes for name, nodes in state.services.items() if self._providers.get(name) != nodes}
        self._remove([name for name in self._services if name not in state.services or name in new])
        self._providers = {name: nodes for name, nodes in state.services.items() if name not in new}
        probes = asyncio.Semaphore(_MAX_PROBES)
        kinds = await asyncio.gather(*(self._find_kind(node, name, probes) for name in new))
        retried = {name for name in new if 0 < self._failures.get(name, 0) < _ATTEMPTS}
        self._providers |= {name: nodes for name, nodes in new.items() if name not in retried}
        self._failures = {name: count for name, count in self._failures.items() if name in state.services}
        added: list[_Service] = []
        for name, kind in zip(new, kinds, strict=True):
            if kind is not None and name not in self._services:
                number = next(self._ids)
                added.append(_Service(id=number, name=name, kind=kind, offer=_offer(node, number, name, kind)))
        self._services |= {service.name: service for service in added}
        for client in self._hub.clients if added else ():
            client.send(AdvertiseServices(tuple(service.offer for service in added)))

    def call(self, node: Node, client: Connection, message: bytes) -> None:
        """Call a service with a client's message."""
        if len(message) < SERVICE_HEADER.size:
            client.send_status(WARNING, "a service call is shorter than its header")
            return
        _, service_id, call_id, length = SERVICE_HEADER.unpack_from(message)
        body = SERVICE_HEADER.size + length
        calls = self._calls.setdefault(client, set())
        service = next((service for service in self._services.values() if service.id == service_id), None)
        if service is None:
            self._fail(client, service_id, call_id, f"no service {service_id}")
        elif message[SERVICE_HEADER.size : body] != ENCODING.encode():
            self._fail(client, service_id, call_id, f"the encoding must be {ENCODING}")
        elif len(calls) >= MAX_IN_FLIGHT:
            self._fail(client, service_id, call_id, f"{MAX_IN_FLIGHT} calls are pending")
        else:
            task = asyncio.get_running_loop().create_task(self._call(node, client, service, call_id, message[body:]))
            calls.add(task)
            task.add_done_callback(calls.discard)

    def forget(self, client: Connection) -> None:
        """Cancel the calls of a client that has disconnected."""
        for task in self._calls.pop(client, ()):
            task.cancel()

    async def _call(self, node: Node, client: Connection, service: _Service, call_id: int, body: bytes) -> None:
        try:
            node.messages.deserialize(body, service.kind.request)
            answer = await call_service_bytes(node, service.name, service.kind, body)
        except RosError as error:
            self._fail(client, service.id, call_id, str(error))
        else:
            client.send_binary((service_header(service.id, call_id), answer))

    def _fail(self, client: Connection, service_id: int, call_id: int, message: str) -> None:
        client.send(ServiceCallFailure(service_id=service_id, call_id=call_id, message=message))

    async def _find_kind(self, node: Node, name: str, probes: asyncio.Semaphore) -> ServiceType | None:
        """Return a service's type; None: its provider does not answer, or its definition is unknown."""
        try:
            type_name = _LOGGERS.get(name.rpartition("/")[2])
            if type_name is None:
                async with probes:
                    uri = str(await node.master.call("lookupService", name))
                    type_name = (await probe_service(uri, name, node.name)).get("type", "")
            kind = await asyncio.to_thread(node.messages.service, type_name)
            await asyncio.to_thread(_schemas, node, kind)
            return kind
        except MessageError:
            return None
        except RosError:  # the provider may be starting: it is probed again, a few times
            self._failures[name] = self._failures.get(name, 0) + 1
            return None

    def _remove(self, names: list[str]) -> None:
        ids = tuple(self._services.pop(name).id for name in names)
        for client in self._hub.clients if ids else ():
            client.send(UnadvertiseServices(ids))


def _schemas(node: Node, kind: ServiceType) -> tuple[str, str]:
    """Return the definitions of request and response; raises MessageError if one is unknown."""
    return node.messages.definition(kind.request), node.messages.definition(kind.response)


def _offer(node: Node, number: int, name: str, kind: ServiceType) -> ServiceOffer:
    request, response = _schemas(node, kind)
    return ServiceOffer(
        id=number,
        name=name,
        type=kind.type,
        request=ServiceSchema(schema_name=f"{kind.type}_Request", schema=request),
        response=ServiceSchema(schema_name=f"{kind.type}_Response", schema=response),
        request_schema=request,
        response_schema=response,
    )
