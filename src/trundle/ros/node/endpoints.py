"""Publishers, subscriptions and services of one node, and their registration at the master.

Adding and removing is thread-safe and does not block; everything else runs on the loop.
"""

import threading
from collections import Counter
from collections.abc import Awaitable, Callable
from contextlib import AbstractContextManager
from functools import partial
from typing import Any

from ..errors import MasterError, MessageError
from .endpoint_recorder import Endpoint, EndpointRecorder
from .node_context import NodeContext
from .publisher import Publisher
from .registration_queue import RegistrationQueue
from .service import Service
from .subscription import Subscription

_CALLS = {
    f"{prefix}{method}": f"{prefix} {noun}"
    for prefix in ("register", "unregister")
    for method, noun in (("Publisher", "publication"), ("Subscriber", "subscription"), ("Service", "service"))
}


class NodeEndpoints:
    """Publishers, subscriptions and services of one node."""

    def __init__(self, node: NodeContext, registrations: RegistrationQueue) -> None:
        self._node = node
        self._registrations = registrations
        self._lock = threading.Lock()
        self._publishers: dict[str, Publisher] = {}
        self._subscriptions: dict[str, list[Subscription]] = {}
        self._services: dict[str, Service] = {}
        self._updates = Counter[str]()
        """Topic → number of its updates from the master."""
        self._unregistering: set[tuple[str, str]] = set()
        """Pairs (method, name) of unregistrations queued or in progress."""
        self._recorder = EndpointRecorder()
        self.changes = 0
        """Number of endpoints added or removed so far."""

    # -- adding and removing: thread-safe

    def add_publisher(self, topic: str, type_name: str, make: Callable[[], Publisher]) -> Publisher:
        """Return the publisher of a topic; creates and registers it if missing.

        Raises:
            MessageError: the topic is already published with another type.
        """
        with self._lock:
            existing = self._publishers.get(topic)
            if existing is not None:
                if existing.type != type_name:
                    raise MessageError(f"{self._node.name} publishes {topic} as {existing.type}, not as {type_name}")
                self._recorder.add(existing)
                return existing
            publisher = self._publishers[topic] = make()
            self.changes += 1
        self._recorder.add(publisher)
        self._node.loop.call_soon(lambda: self._node.loop.local.publishers.add(publisher))
        for listener in self._node.loop.local.on_publisher:
            self._node.loop.call_soon(lambda listener=listener: listener(publisher))
        self._register_publisher(publisher)
        return publisher

    def add_subscription(self, subscription: Subscription) -> None:
        """Register a subscription."""
        with self._lock:
            self._subscriptions.setdefault(subscription.topic, []).append(subscription)
            self.changes += 1
        self._recorder.add(subscription)
        self._registrations.add(lambda: self._register_subscriber(subscription.topic, subscription.type))

    def add_service(self, service: Service) -> None:
        """Register a service; replaces an earlier one of that name."""
        with self._lock:
            self._services[service.name] = service
            self.changes += 1
        self._recorder.add(service)
        self._registrations.add(lambda: self._register_service(service.name))

    def register_again(self) -> None:
        """Register everything again, at a restarted master."""
        for publisher in self.publishers:
            self._register_publisher(publisher)
        for topic, type_name in self.subscribed_topics():
            self._registrations.add(partial(self._register_subscriber, topic, type_name, keep_publishers=True))
        for name in list(self._services):
            self._registrations.add(partial(self._register_service, name))

    def remove_publisher(self, publisher: Publisher) -> None:
        """Remove and unregister a publisher."""
        with self._lock:
            if self._publishers.get(publisher.topic) is not publisher:
                return
            del self._publishers[publisher.topic]
            self.changes += 1
        self._node.loop.call_soon(publisher.close)
        self._queue_unregister("unregisterPublisher", publisher.topic)

    def remove_subscription(self, subscription: Subscription) -> None:
        """Remove a subscription; unregisters at the master with the last one of the topic."""
        with self._lock:
            others = self._subscriptions.get(subscription.topic, [])
            if subscription not in others:
                return
            others.remove(subscription)
            self.changes += 1
            if not others:
                del self._subscriptions[subscription.topic]
        self._node.loop.call_soon(subscription.close)
        if not others:
            self._queue_unregister("unregisterSubscriber", subscription.topic)

    def remove_service(self, service: Service) -> None:
        """Remove and unregister a service."""
        with self._lock:
            if self._services.get(service.name) is not service:
                return
            del self._services[service.name]
            self.changes += 1
        self._node.loop.call_soon(service.close)
        self._queue_unregister("unregisterService", service.name)

    def record(self) -> AbstractContextManager[list[Endpoint]]:
        """Record the endpoints this thread creates in the context."""
        return self._recorder.record()

    # -- queries

    @property
    def publishers(self) -> list[Publisher]:
        """Publishers of this node."""
        return list(self._publishers.values())

    @property
    def subscriptions(self) -> list[Subscription]:
        """Subscriptions of this node."""
        return [subscription for subscriptions in self._subscriptions.values() for subscription in subscriptions]

    def publisher(self, topic: str) -> Publisher | None:
        """Find a publisher by its topic's global name."""
        return self._publishers.get(topic)

    def service(self, name: str) -> Service | None:
        """Find a service by its global name."""
        return self._services.get(name)

    def published_topics(self) -> list[tuple[str, str]]:
        """Pairs (topic, type) of all publishers."""
        return [(publisher.topic, publisher.type) for publisher in self._publishers.values()]

    def subscribed_topics(self) -> list[tuple[str, str]]:
        """Pairs (topic, type) of all subscriptions."""
        return [(topic, subscriptions[0].type) for topic, subscriptions in self._subscriptions.items()]

    def connections(self) -> list[list[int | str | bool]]:
        """All connections, in the form of getBusInfo."""
        return [link for end in (*self.publishers, *self.subscriptions) for link in end.connections()]

    def statistics(self) -> list[list[object]]:
        """Counts of bytes and messages, in the form of getBusStats."""
        return [[p.statistics() for p in self.publishers], [s.statistics() for s in self.subscriptions], []]

    # -- on the loop

    def publishers_changed(self, topic: str, uris: list[str]) -> None:
        """Handle publisherUpdate: connect to these publishers."""
        if topic in self._subscriptions:
            self._updates[topic] += 1
        for subscription in self._subscriptions.get(topic, []):
            subscription.follow(uris)

    def unregister_all(self) -> list[Awaitable[None]]:
        """Master calls that unregister everything."""
        calls = {("unregisterService", name) for name in self._services} | self._unregistering
        calls |= {("unregisterSubscriber", topic) for topic in self._subscriptions}
        calls |= {("unregisterPublisher", topic) for topic in self._publishers}
        return [self._unregister(method, name) for method, name in calls]

    def close(self) -> None:
        """Close all connections."""
        for end in (*self.publishers, *self.subscriptions, *self._services.values()):
            end.close()

    def _register_publisher(self, publisher: Publisher) -> None:
        topic, kind = publisher.topic, publisher.type
        self._registrations.add(lambda: self._notify_master("registerPublisher", topic, kind, self._node.uri))

    def _queue_unregister(self, method: str, name: str) -> None:
        """Queue an unregistration; done at shutdown if still queued."""
        self._unregistering.add((method, name))

        async def unregister() -> None:
            await self._unregister(method, name)
            self._unregistering.discard((method, name))

        self._registrations.add(unregister)

    async def _unregister(self, method: str, name: str) -> None:
        await self._notify_master(
            method, name, self._node.service_uri if method == "unregisterService" else self._node.uri
        )

    async def _call_master(self, method: str, name: str, *arguments: object) -> Any:
        try:
            return await self._node.master.call(method, name, *arguments)
        except MasterError as error:
            raise MasterError(f"unable to {_CALLS[method]} [{name}] with master: {error}") from None

    async def _notify_master(self, method: str, name: str, *arguments: object) -> None:
        await self._call_master(method, name, *arguments)

    async def _register_service(self, name: str) -> None:
        await self._notify_master("registerService", name, self._node.service_uri, self._node.uri)
        self._node.loop.local.notify_service_change()

    async def _register_subscriber(self, topic: str, type_name: str, *, keep_publishers: bool = False) -> None:
        """Register the subscriptions of a topic; `keep_publishers`: keep connected publishers, which may not have
        registered again yet.
        """
        before = self._updates[topic]
        publishers = await self._call_master("registerSubscriber", topic, type_name, self._node.uri)
        may_be_old = self._updates[topic] != before  # than the update that came since
        uris = [str(uri) for uri in publishers]
        for subscription in self._subscriptions.get(topic, []):
            (subscription.add_publishers if keep_publishers or may_be_old else subscription.follow)(uris)
