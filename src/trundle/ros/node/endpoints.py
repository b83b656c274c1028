"""Publishers, subscriptions and services of one node, and their registration at the master.

Any thread may add and remove one, and does not wait; the rest is read on the loop.
"""

import threading
from collections.abc import Awaitable, Callable
from contextlib import AbstractContextManager

from ..errors import MessageError
from .endpoint_recorder import Endpoint, EndpointRecorder
from .node_context import NodeContext
from .publisher import Publisher
from .registration_queue import RegistrationQueue
from .service import Service
from .subscription import Subscription


class NodeEndpoints:
    """One node's ends of topics and services."""

    def __init__(self, node: NodeContext, registrations: RegistrationQueue) -> None:
        self._node = node
        self._registrations = registrations
        self._lock = threading.Lock()
        self._publishers: dict[str, Publisher] = {}
        self._subscriptions: dict[str, list[Subscription]] = {}
        self._services: dict[str, Service] = {}
        self._unregistering: set[tuple[str, str]] = set()
        """(method, name) of what the master has still to be told that it has ended."""
        self._recorder = EndpointRecorder()

    # -- adding and removing: any thread

    def add_publisher(self, topic: str, type_name: str, make: Callable[[], Publisher]) -> Publisher:
        """Return the publisher of a topic, which is made and registered unless it is there.

        Raises:
            MessageError: the topic is already published with another type.
        """
        with self._lock:
            there = self._publishers.get(topic)
            if there is not None:
                if there.type != type_name:
                    raise MessageError(f"{self._node.name} publishes {topic} as {there.type}, not as {type_name}")
                self._recorder.add(there)
                return there
            publisher = self._publishers[topic] = make()
        self._recorder.add(publisher)
        for listener in self._node.loop.local.on_publisher:
            self._node.loop.call_soon(lambda listener=listener: listener(publisher))
        self._registrations.add(lambda: self._notify_master("registerPublisher", topic, type_name, self._node.uri))
        return publisher

    def add_subscription(self, subscription: Subscription) -> None:
        """Register a subscription."""
        with self._lock:
            self._subscriptions.setdefault(subscription.topic, []).append(subscription)
        self._recorder.add(subscription)
        self._registrations.add(lambda: self._register_subscriber(subscription.topic, subscription.type))

    def add_service(self, service: Service) -> None:
        """Register a service, in place of an earlier one of that name."""
        with self._lock:
            self._services[service.name] = service
        self._recorder.add(service)
        self._registrations.add(lambda: self._register_service(service.name))

    def remove_publisher(self, publisher: Publisher) -> None:
        """Stop publishing a topic."""
        with self._lock:
            if self._publishers.get(publisher.topic) is not publisher:
                return
            del self._publishers[publisher.topic]
        self._node.loop.call_soon(publisher.close)
        self._queue_unregister("unregisterPublisher", publisher.topic)

    def remove_subscription(self, subscription: Subscription) -> None:
        """Stop listening; the master is told when nothing in this node listens to the topic any more."""
        with self._lock:
            others = self._subscriptions.get(subscription.topic, [])
            if subscription not in others:
                return
            others.remove(subscription)
            if not others:
                del self._subscriptions[subscription.topic]
        self._node.loop.call_soon(subscription.close)
        if not others:
            self._queue_unregister("unregisterSubscriber", subscription.topic)

    def remove_service(self, service: Service) -> None:
        """Stop providing a service."""
        with self._lock:
            if self._services.get(service.name) is not service:
                return
            del self._services[service.name]
        self._node.loop.call_soon(service.close)
        self._queue_unregister("unregisterService", service.name)

    def record(self) -> AbstractContextManager[list[Endpoint]]:
        """Note what this thread has the node advertise, subscribe or provide meanwhile."""
        return self._recorder.record()

    # -- what there is

    @property
    def publishers(self) -> list[Publisher]:
        """What this node publishes."""
        return list(self._publishers.values())

    @property
    def subscriptions(self) -> list[Subscription]:
        """What this node subscribes to."""
        return [subscription for subscriptions in self._subscriptions.values() for subscription in subscriptions]

    def publisher(self, topic: str) -> Publisher | None:
        """Find a publisher by its topic's global name."""
        return self._publishers.get(topic)

    def service(self, name: str) -> Service | None:
        """Find a service by its global name."""
        return self._services.get(name)

    def published_topics(self) -> list[tuple[str, str]]:
        """Topics with the type this node publishes."""
        return [(publisher.topic, publisher.type) for publisher in self._publishers.values()]

    def subscribed_topics(self) -> list[tuple[str, str]]:
        """Topics with the type this node expects."""
        return [(topic, subscriptions[0].type) for topic, subscriptions in self._subscriptions.items()]

    def connections(self) -> list[list[object]]:
        """All links, as getBusInfo tells them."""
        return [link for end in (*self.publishers, *self.subscriptions) for link in end.connections()]

    def statistics(self) -> list[list[object]]:
        """Bytes and messages, as getBusStats tells them."""
        return [[p.statistics() for p in self.publishers], [s.statistics() for s in self.subscriptions], []]

    # -- on the loop

    def publishers_changed(self, topic: str, uris: list[str]) -> None:
        """Follow what the master says about a topic's publishers."""
        for subscription in self._subscriptions.get(topic, []):
            subscription.follow(uris)

    def unregister_all(self) -> list[Awaitable[None]]:
        """Calls that take everything from the master's lists."""
        ended = {("unregisterService", name) for name in self._services} | self._unregistering
        ended |= {("unregisterSubscriber", topic) for topic in self._subscriptions}
        ended |= {("unregisterPublisher", topic) for topic in self._publishers}
        return [self._unregister(method, name) for method, name in ended]

    def close(self) -> None:
        """Drop every peer."""
        for end in (*self.publishers, *self.subscriptions, *self._services.values()):
            end.close()

    def _queue_unregister(self, method: str, name: str) -> None:
        """Have the master told; if the node shuts down before, by then."""
        self._unregistering.add((method, name))

        async def unregister() -> None:
            await self._unregister(method, name)
            self._unregistering.discard((method, name))

        self._registrations.add(unregister)

    async def _unregister(self, method: str, name: str) -> None:
        await self._notify_master(
            method, name, self._node.service_uri if method == "unregisterService" else self._node.uri
        )

    async def _notify_master(self, method: str, *arguments: object) -> None:
        await self._node.master.call(method, *arguments)

    async def _register_service(self, name: str) -> None:
        await self._notify_master("registerService", name, self._node.service_uri, self._node.uri)
        self._node.loop.local.notify_service_change()

    async def _register_subscriber(self, topic: str, type_name: str) -> None:
        uris = await self._node.master.call("registerSubscriber", topic, type_name, self._node.uri)
        self.publishers_changed(topic, [str(uri) for uri in uris])
