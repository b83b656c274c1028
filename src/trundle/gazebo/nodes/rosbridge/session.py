"""One client's operations of the rosbridge protocol, version 2."""

import asyncio
import json
from collections.abc import Awaitable, Callable, Mapping
from typing import Any, Protocol

from trundle.base.diagnostics import TrundleError

from ..globs import allows
from . import checks
from .errors import RosbridgeError
from .fragments import Reassembly, split
from .services import ClientService, call_service
from .shared import Shared
from .status import Status
from .subscriptions import Settings, Subscription, dump_json, make_subscription

_MAX_TOPICS = 1000
_MAX_SERVICES = 100
_MAX_CALLS = 1000
_QUEUE_SIZE = 100
_MAX_QUEUE_SIZE = 10_000
_MAX_QUOTED = 500

Operation = Callable[[dict[str, Any]], Awaitable[None]]


class Outbox(Protocol):
    """Queue of messages to the client."""

    def put(self, message: str | bytes) -> bool:
        """Queue a message; False: the client is too slow."""
        ...

    async def wait_idle(self) -> None:
        """Wait until the client is not busy."""
        ...


class Session:
    """A client's session; used on the loop."""

    def __init__(self, number: int, shared: Shared, outbox: Outbox) -> None:
        self._number = number
        self._shared = shared
        self._node = shared.node
        self._options = shared.options
        self._outbox = outbox
        self._status = Status(number, shared.node.log, self._send)
        self._fragment_size = shared.options.fragment_size
        self._reassembly = Reassembly(shared.options.fragment_timeout_s)
        self._advertised: dict[str, set[object]] = {}
        self._published: set[str] = set()
        self._subscriptions: dict[str, Subscription] = {}
        self._services: dict[str, ClientService] = {}
        self._calls: set[asyncio.Task[None]] = set()
        self._operations: dict[str, Operation] = {
            "advertise": self._advertise,
            "unadvertise": self._unadvertise,
            "publish": self._publish,
            "subscribe": self._subscribe,
            "unsubscribe": self._unsubscribe,
            "call_service": self._call_service,
            "advertise_service": self._advertise_service,
            "unadvertise_service": self._unadvertise_service,
            "service_response": self._respond,
            "fragment": self._defragment,
            "set_level": self._set_level,
        }

    async def receive(self, data: str | bytes) -> None:
        """Handle a message of the client."""
        text = data.decode("utf-8", "replace") if isinstance(data, bytes) else data
        try:
            message = json.loads(text)
        except (ValueError, RecursionError):
            self._status.report("error", f"not a JSON object: {text[:_MAX_QUOTED]!r}")
            return
        await self.handle(message)

    async def handle(self, message: object) -> None:
        """Handle a decoded message."""
        if not isinstance(message, dict):
            self._status.report("error", f"Expected a JSON object but received a {type(message)}")
            return
        fields: dict[str, Any] = message
        key, name = fields.get("id"), fields.get("op")
        operation = self._operations.get(name) if isinstance(name, str) else None
        names = list(self._operations)
        if "op" not in fields:
            original = str(fields)[:_MAX_QUOTED]
            self._status.report(
                "error",
                "Received a message without an op.  All messages require 'op' field with value one of: "
                f"{names}.  Original message was: {original}",
                key,
            )
        elif operation is None:
            shown = str(name)[:_MAX_QUOTED]
            self._status.report("error", f"Unknown operation: {shown}.  Allowed operations: {names}", key)
        else:
            try:
                self._set_fragment_size(fields)
                await operation(fields)
            except (RosbridgeError, TrundleError, RecursionError) as error:
                self._status.report("error", f"{name}: {error}", key)

    def close(self) -> None:
        """Release everything of the client."""
        for call in self._calls:
            call.cancel()
        for subscription in self._subscriptions.values():
            subscription.close()
        for topic in {*self._advertised, *self._published}:
            self._shared.publishers.unregister(self._number, topic)
        for name, service in self._services.items():
            self._drop_service(name, service)

    # -- topics

    async def _advertise(self, message: dict[str, Any]) -> None:
        checks.check_fields(message, checks.ADVERTISE)
        topic = message["topic"]
        if self._is_hidden("topic", topic, self._options.topics_glob, "advertisement of"):
            return
        if len(self._advertised) >= _MAX_TOPICS and topic not in self._advertised:
            raise RosbridgeError(f"{_MAX_TOPICS} topics are advertised already")
        await self._register(message, message["type"])
        self._advertised.setdefault(topic, set()).add(_hashable(message.get("id")))

    async def _unadvertise(self, message: dict[str, Any]) -> None:
        checks.check_fields(message, (checks.TOPIC,))
        topic, key = message["topic"], _hashable(message.get("id"))
        if self._is_hidden("topic", topic, self._options.topics_glob, "unadvertisement of"):
            return
        keys = self._advertised.get(topic)
        if keys is None:
            return
        keys.discard(key)
        if key is None or not keys:
            del self._advertised[topic]
            self._published.discard(topic)
            self._shared.publishers.unregister(self._number, topic)

    async def _publish(self, message: dict[str, Any]) -> None:
        checks.check_fields(message, checks.PUBLISH)
        topic = message["topic"]
        if self._is_hidden("topic", topic, self._options.topics_glob, "publish to"):
            return
        if topic not in self._published and topic not in self._advertised:
            if len(self._published) >= _MAX_TOPICS:
                raise RosbridgeError(f"{_MAX_TOPICS} topics are published already")
            await self._register(message, None)
            self._published.add(topic)
        self._shared.publishers.publish(topic, message.get("msg", {}))

    async def _register(self, message: dict[str, Any], kind: str | None) -> None:
        warning = await self._shared.publishers.register(
            self._number,
            message["topic"],
            requested_type=kind,
            latch=bool(message.get("latch", False)),
            queue_size=min(max(message.get("queue_size", _QUEUE_SIZE), 1), _MAX_QUEUE_SIZE),
        )
        if warning is not None:
            self._status.report("warning", warning, message.get("id"))

    async def _subscribe(self, message: dict[str, Any]) -> None:
        checks.check_fields(message, checks.SUBSCRIBE)
        topic, key = message["topic"], _hashable(message.get("id"))
        if self._is_hidden("topic", topic, self._options.topics_glob, "subscription to"):
            return
        settings = Settings(
            throttle_ms=message.get("throttle_rate", 0),
            queue_length=message.get("queue_length", 0),
            compression=message.get("compression", "none"),
        )
        if topic not in self._subscriptions:
            if len(self._subscriptions) >= _MAX_TOPICS:
                raise RosbridgeError(f"{_MAX_TOPICS} topics are subscribed already")
            self._subscriptions[topic] = await make_subscription(
                self._node,
                topic,
                message.get("type"),
                encoder=self._shared.encoder,
                send=self._send_encoded,
                wait_idle=self._outbox.wait_idle,
                is_raw=settings.compression == "cbor-raw",
            )
        self._subscriptions[topic].subscribe(key, settings)
        self._status.report("info", f"Subscribed to {topic}", key)

    async def _unsubscribe(self, message: dict[str, Any]) -> None:
        checks.check_fields(message, (checks.TOPIC,))
        topic, key = message["topic"], _hashable(message.get("id"))
        subscription = self._subscriptions.get(topic)
        if subscription is None:
            return
        subscription.unsubscribe(key)
        if subscription.is_empty:
            del self._subscriptions[topic]
        self._status.report("info", f"Unsubscribed from {topic}", key)

    # -- services

    async def _call_service(self, message: dict[str, Any]) -> None:
        checks.check_fields(message, checks.CALL_SERVICE)
        name, hash_, old_key = message["service"].partition("#")
        if self._is_hidden("service", name, self._options.services_glob, "service call for"):
            return
        if len(self._calls) >= _MAX_CALLS:
            raise RosbridgeError(f"{_MAX_CALLS} calls are in progress already")
        key = message.get("id")
        if key is None and hash_:
            key = old_key
        call = asyncio.create_task(self._answer_call(message, name, key))
        self._calls.add(call)
        call.add_done_callback(self._calls.discard)

    async def _answer_call(self, message: Mapping[str, Any], name: str, key: object) -> None:
        response: dict[str, Any] = {"op": "service_response", "service": message["service"]}
        try:
            values: Any = await call_service(self._node, self._shared.encoder, name, message.get("args", []))
            response |= {"values": values, "result": True}
        except (RosbridgeError, TrundleError, RecursionError) as error:
            self._status.report("error", f"call_service {type(error).__name__}: {error}", key)
            response |= {"values": str(error), "result": False}
        self._send(response if key is None else {**response, "id": key})

    async def _advertise_service(self, message: dict[str, Any]) -> None:
        checks.check_fields(message, checks.ADVERTISE_SERVICE)
        name = message["service"]
        if self._is_hidden("service", name, self._options.services_glob, "service advertisement for"):
            return
        if len(self._services) >= _MAX_SERVICES:
            raise RosbridgeError(f"{_MAX_SERVICES} services are advertised already")
        self._node.messages.service(message["type"])
        existing = self._shared.services.get(name)
        if existing is not None:
            self._status.report("warning", f"Duplicate service advertised. Overwriting {name}.", message.get("id"))
            self._drop_service(name, existing)
        service = ClientService(self._node, name, message["type"], self._shared.encoder, self._send)
        self._services[name] = self._shared.services[name] = service
        self._status.report("info", f"Advertised service {name}.", message.get("id"))

    async def _unadvertise_service(self, message: dict[str, Any]) -> None:
        checks.check_fields(message, (checks.SERVICE,))
        name = message["service"]
        if self._is_hidden("service", name, self._options.services_glob, "service unadvertisement for"):
            return
        service = self._shared.services.get(name)
        if service is None:
            text = f"Service {name} has not been advertised via rosbridge, can't unadvertise."
            self._status.report("error", text, message.get("id"))
            return
        self._drop_service(name, service)
        self._services.pop(name, None)
        self._status.report("info", f"Unadvertised service {name}.", message.get("id"))

    async def _respond(self, message: dict[str, Any]) -> None:
        checks.check_fields(message, checks.SERVICE_RESPONSE)
        name = message["service"]
        service = self._shared.services.get(name)
        if service is None:
            self._status.report("error", f"Service {name} has not been advertised via rosbridge.", message.get("id"))
            return
        service.respond(message["id"], message.get("values", {}))

    def _drop_service(self, name: str, service: ClientService) -> None:
        service.close()
        if self._shared.services.get(name) is service:
            del self._shared.services[name]

    # -- the protocol itself

    async def _defragment(self, message: dict[str, Any]) -> None:
        complete = self._reassembly.add(message)
        if complete is not None:
            await self.receive(complete)

    async def _set_level(self, message: dict[str, Any]) -> None:
        self._status.set_level(message.get("level"))

    def _set_fragment_size(self, message: Mapping[str, Any]) -> None:
        size = message.get("fragment_size")
        if isinstance(size, int) and not isinstance(size, bool):
            if size < 1:
                raise RosbridgeError(f"fragment_size must be > 0, got {size}")
            self._fragment_size = size

    def _is_hidden(self, entity: str, name: str, globs: tuple[str, ...], action: str) -> bool:
        if allows(globs, name):
            return False
        self._status.report("warning", f"No match found for {entity}, cancelling {action}: {name}")
        return True

    def _send(self, message: dict[str, Any]) -> None:
        if not self._send_encoded(dump_json(message), message.get("id")):
            self._node.log.warn(f"client {self._number} is too slow; a {message['op']} to it is dropped")

    def _send_encoded(self, data: str | bytes, key: object = None) -> bool:
        size = self._fragment_size
        if size is None or isinstance(data, bytes) or len(data) <= size:
            return self._outbox.put(data)
        return all(self._outbox.put(part) for part in split(data, size, key))


def _hashable(key: object) -> object:
    return key if isinstance(key, str | int | float | None) else str(key)
