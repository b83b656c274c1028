"""What a node publishes, subscribes and provides, as it begins and ends; its word with the master about that.

Any thread may begin and end a thing, and does not wait.
"""

import asyncio
import threading
from collections.abc import Callable
from contextlib import AbstractContextManager
from typing import TYPE_CHECKING

from ..errors import MessageError
from ..messages.messages import ANY_TYPE
from .endpoint_recorder import Endpoint, EndpointRecorder
from .links import NodeLinks
from .master_calls import NodeMasterCalls
from .publisher import Publisher
from .registration_queue import RegistrationQueue
from .service import Service, ServiceCallback
from .slave import Slave
from .subscription import Callback, Subscription

if TYPE_CHECKING:
    from .node import Node


class NodeEndpoints(NodeMasterCalls, NodeLinks):
    """One node's ends of topics and services."""

    _slave: Slave
    _registrations: RegistrationQueue

    def __init__(self) -> None:
        """Have none yet."""
        self._lock = threading.Lock()
        self._publishers: dict[str, Publisher] = {}
        self._subscriptions: dict[str, list[Subscription]] = {}
        self._publisher_uris: dict[str, list[str]] = {}
        self._services: dict[str, Service] = {}
        self._unregistering: set[tuple[str, str]] = set()
        """What the master has still to be told that it has ended."""
        self._recorder = EndpointRecorder()

    @property
    def _node(self) -> "Node":
        """The whole that this is a part of."""
        raise NotImplementedError

    def advertise(
        self,
        topic: str,
        type_name: str,
        *,
        latch: bool = False,
        queue_size: int | None = 10,
        on_connect: Callable[[Publisher], None] | None = None,
        raw_type: tuple[str, str] | None = None,
    ) -> Publisher:
        """Publish a topic; a second call for the same topic returns the same publisher.

        Args:
            topic: resolved and remapped.
            type_name: such as 'geometry_msgs/Twist'.
            latch: whether new subscribers get the last message.
            queue_size: how many messages wait for a subscriber that reads too slowly; None: any number.
            on_connect: called on the loop whenever a subscriber has connected.
            raw_type: (md5 sum, definition) of a type that need not be known here; messages are given as bytes.

        Raises:
            MessageError: no such type, or the topic is already published with another.
        """
        name = self.resolve(topic)
        if raw_type is None:
            self.messages.md5(type_name)
        with self._lock:
            there = self._publishers.get(name)
            if there is not None:
                if there.type != type_name:
                    raise MessageError(f"{self.name} publishes {name} as {there.type}, not as {type_name}")
                self._recorder.add(there)
                return there
            publisher = Publisher(
                self._node,
                name,
                type_name,
                latch=latch,
                queue_size=queue_size,
                on_connect=on_connect,
                raw_type=raw_type,
            )
            self._publishers[name] = publisher
        self._recorder.add(publisher)
        for listener in self.loop.on_publisher:
            self.loop.call_soon(lambda listener=listener: listener(publisher))
        self._registrations.add(lambda: self._notify_master("registerPublisher", name, type_name, self.uri))
        return publisher

    def subscribe(
        self,
        topic: str,
        type_name: str,
        callback: Callback,
        *,
        queue_size: int | None = 10,
        tcp_nodelay: bool = True,
        on_loop: bool = False,
    ) -> Subscription:
        """Subscribe to a topic.

        Args:
            topic: resolved and remapped.
            type_name: such as 'geometry_msgs/Twist', or '*' for messages of any type as `RawMessage`.
            callback: function or coroutine function of the message; what it raises is logged.
            queue_size: how many messages wait for callbacks that are too slow; None: any number.
            tcp_nodelay: whether to ask publishers for small delays rather than full packets.
            on_loop: call back on the loop even if this node delivers elsewhere.

        Raises:
            MessageError: no such type.
        """
        name = self.resolve(topic)
        if type_name != ANY_TYPE:
            self.messages.md5(type_name)
        subscription = Subscription(
            self._node, name, type_name, callback, queue_size=queue_size, tcp_nodelay=tcp_nodelay, on_loop=on_loop
        )
        with self._lock:
            self._subscriptions.setdefault(name, []).append(subscription)
        self._recorder.add(subscription)
        self._registrations.add(lambda: self._register_subscriber(name, type_name))
        return subscription

    def advertise_service(self, name: str, type_name: str, handler: ServiceCallback) -> Service:
        """Provide a service.

        Args:
            name: resolved and remapped.
            type_name: such as 'std_srvs/SetBool'.
            handler: function or coroutine function of the request; returns the response or its fields as a
                dictionary, or raises ServiceError for "no". A coroutine function runs on the loop even if this node
                delivers elsewhere.

        Raises:
            MessageError: no such type.
        """
        full = self.resolve(name)
        service = Service(self._node, full, type_name, handler)
        with self._lock:
            self._services[full] = service
        self._recorder.add(service)
        self._registrations.add(lambda: self._register_service(full))
        return service

    def recording_endpoints(self) -> AbstractContextManager[list[Endpoint]]:
        """Note what this thread has the node advertise, subscribe or provide meanwhile."""
        return self._recorder.record()

    def unregister_publisher(self, publisher: Publisher) -> None:
        """Stop publishing a topic."""
        with self._lock:
            if self._publishers.get(publisher.topic) is not publisher:
                return
            del self._publishers[publisher.topic]
        self.loop.call_soon(publisher.close)
        self._queue_unregister("unregisterPublisher", publisher.topic)

    def unregister_subscription(self, subscription: Subscription) -> None:
        """Stop listening; the master is told when nothing in this node listens to the topic any more."""
        with self._lock:
            others = self._subscriptions.get(subscription.topic, [])
            if subscription not in others:
                return
            others.remove(subscription)
            if not others:
                del self._subscriptions[subscription.topic]
        self.loop.call_soon(subscription.close)
        if not others:
            self._queue_unregister("unregisterSubscriber", subscription.topic)

    def unregister_service(self, service: Service) -> None:
        """Stop providing a service."""
        with self._lock:
            if self._services.get(service.name) is not service:
                return
            del self._services[service.name]
        self.loop.call_soon(service.close)
        self._queue_unregister("unregisterService", service.name)

    def _queue_unregister(self, method: str, name: str) -> None:
        """Have the master told; if the node shuts down before, by then."""
        self._unregistering.add((method, name))

        async def leave() -> None:
            await self._unregister_at_master(method, name)
            self._unregistering.discard((method, name))

        self._registrations.add(leave)

    async def _unregister_all(self) -> None:
        ended = {("unregisterService", name) for name in self._services} | self._unregistering
        ended |= {("unregisterSubscriber", topic) for topic in self._subscriptions}
        ended |= {("unregisterPublisher", topic) for topic in self._publishers}
        farewells = [self._unregister_at_master(method, name) for method, name in ended]
        farewells += [self._notify_master("unsubscribeParam", self.uri, name) for name in self.watched]
        await asyncio.gather(*farewells, return_exceptions=True)

    def _close_all(self) -> None:
        """Drop every peer."""
        for publisher in self._publishers.values():
            publisher.close()
        for subscriptions in self._subscriptions.values():
            for subscription in subscriptions:
                subscription.close()
        for service in self._services.values():
            service.close()

    async def _unregister_at_master(self, method: str, name: str) -> None:
        await self._notify_master(method, name, self._slave.service_uri if method == "unregisterService" else self.uri)

    async def _notify_master(self, method: str, *arguments: object) -> None:
        await self.call_master(method, *arguments)

    async def _register_service(self, service: str) -> None:
        await self.call_master("registerService", service, self._slave.service_uri, self.uri)
        self.loop.notify_service_change()

    async def _register_subscriber(self, topic: str, type_name: str) -> None:
        uris = await self.call_master("registerSubscriber", topic, type_name, self.uri)
        self.publishers_changed(topic, [str(uri) for uri in uris])
