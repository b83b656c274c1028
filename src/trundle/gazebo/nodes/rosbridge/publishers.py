"""Publishers of all clients; one per topic."""

import asyncio
import time
from dataclasses import dataclass, field

from trundle.ros import Node, Publisher

from .errors import RosbridgeError, TypeConflictError
from .json_values import JsonDecoder
from .topic_types import resolve_type

_HOLD_S = 1.0
"""Time for which a new publisher holds messages for its first subscriber [s]."""
_MAX_PENDING = 100
_MAX_TOPICS = 1000


@dataclass(slots=True)
class _Shared:
    publisher: Publisher
    clients: set[int]
    latching_client: int | None
    was_advertised_before: bool
    created_s: float
    pending: list[dict[str, object]] = field(default_factory=list[dict[str, object]])
    ending: asyncio.TimerHandle | None = None

    @property
    def is_new(self) -> bool:
        return time.monotonic() - self.created_s < _HOLD_S


class Publishers:
    """Publishers by topic, kept for a timeout after the last client has left."""

    def __init__(self, node: Node, unregister_timeout_s: float) -> None:
        self._node = node
        self._timeout_s = unregister_timeout_s
        self._decoder = JsonDecoder(node.messages)
        self._shared: dict[str, _Shared] = {}

    async def register(
        self, client: int, topic: str, *, requested_type: str | None, latch: bool, queue_size: int
    ) -> str | None:
        """Add a client to a topic's publisher; return a warning or None.

        Raises:
            RosbridgeError: the type is unknown, or the topic has another.
            RosError: no such type, or no master.
        """
        name = self._node.resolve(topic)
        shared = self._shared.get(name)
        warning = None
        if shared is None:
            kind = await resolve_type(self._node, topic, requested_type)
            shared = self._shared.get(name) or self._advertise(
                name, kind, client if latch else None, queue_size=queue_size
            )
        elif (latch and shared.latching_client != client) or (not latch and shared.latching_client is not None):
            warning = f"{topic} is registered already, {'' if shared.latching_client is not None else 'not '}latched"
        if requested_type is not None and shared.publisher.type != requested_type.replace("/msg/", "/"):
            raise TypeConflictError(topic, shared.publisher.type, requested_type)
        if shared.ending is not None:
            shared.ending.cancel()
            shared.ending = None
        shared.clients.add(client)
        return warning

    def publish(self, topic: str, message: object) -> None:
        """Publish on a registered topic; a new publisher's messages wait for its first subscriber.

        Raises:
            RosbridgeError: the message does not match the type.
            MessageError: a number is out of range.
        """
        shared = self._shared[self._node.resolve(topic)]
        publisher = shared.publisher
        fields = self._decoder.fields(message, publisher.type, self._node.clock.now_ns())
        if shared.is_new and not publisher.has_subscribers and shared.latching_client is None:
            self._node.messages.new(publisher.type, fields)  # raises if the message is invalid
            if len(shared.pending) < _MAX_PENDING:
                shared.pending.append(fields)
        else:
            publisher.publish(self._node.messages.new(publisher.type, fields))

    def unregister(self, client: int, topic: str) -> None:
        """Remove a client; the last one's publisher ends after the timeout."""
        name = self._node.resolve(topic)
        shared = self._shared.get(name)
        if shared is None:
            return
        shared.clients.discard(client)
        if not shared.clients and shared.ending is None:
            shared.ending = asyncio.get_running_loop().call_later(self._timeout_s, self._end, name)

    def _advertise(self, name: str, kind: str, latching_client: int | None, *, queue_size: int) -> _Shared:
        if len(self._shared) >= _MAX_TOPICS:
            raise RosbridgeError(f"{_MAX_TOPICS} topics are advertised already")
        was_advertised_before = self._node.endpoints.publisher(name) is not None
        publisher = self._node.advertise(
            name,
            kind,
            latch=latching_client is not None,
            queue_size=queue_size,
            on_connect=lambda _: self._publish_pending(name),
        )
        shared = _Shared(publisher, set(), latching_client, was_advertised_before, time.monotonic())
        self._shared[name] = shared
        return shared

    def _publish_pending(self, name: str) -> None:
        shared = self._shared.get(name)
        if shared is not None and shared.pending:
            pending, shared.pending = shared.pending, []
            for fields in pending if shared.is_new else ():
                shared.publisher.publish(fields)

    def _end(self, name: str) -> None:
        shared = self._shared.pop(name)
        if not shared.was_advertised_before:
            shared.publisher.unregister()
