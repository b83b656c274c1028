"""A node: what it publishes, subscribes and provides, and its word with the master.

Registering returns at once, from any thread. Whatever needs an answer is a coroutine of the loop.
"""

import asyncio
import contextlib
import threading
from collections.abc import Callable, Mapping
from contextlib import AbstractContextManager
from typing import Any, TextIO

from trundle.names import canonical_name, join_names, resolve_name

from .clock import Clock, WallClock
from .errands import Errands
from .errors import MasterUnreachableError, MessageError, ServiceError
from .loggers import Loggers
from .loop import GraphLoop
from .messages import ANY_TYPE, Message
from .network import master_uri_from_env, server_address
from .node_calls import NodeCalls, ParamCallback
from .node_links import NodeLinks
from .node_log import NodeLog
from .noted import End, Noted
from .profile import NOETIC
from .publisher import Publisher
from .service import Service, ServiceCallback
from .slave import Slave
from .subscription import Callback, Subscription

_FAREWELL_S = 1.0
"""How long unregistering may take: a whole program must end within two seconds of Ctrl-C."""
_LINK_S = 0.01


class Node(NodeCalls, NodeLinks, NodeLog):
    """One node of the graph."""

    def __init__(
        self,
        name: str,
        *,
        loop: GraphLoop,
        master_uri: str | None = None,
        namespace: str = "/",
        remappings: Mapping[str, str] | None = None,
        params: Mapping[str, Any] | None = None,
        clock: Clock | None = None,
        deliver: Callable[[Callable[[], None]], None] | None = None,
        rosout: bool = True,
        host: str | None = None,
    ) -> None:
        """Make a node and have it start; returns at once.

        Args:
            name: base name such as 'driver'; a name that starts with '/' is taken as it is.
            loop: where it runs.
            master_uri: ROS_MASTER_URI by default.
            namespace: where relative names live.
            remappings: name → name, both as written on a command line.
            params: private parameters, set before anything else happens.
            clock: ROS time; the wall's by default.
            deliver: called on the loop with a function for each message and request that has come in; it must
                return at once, and somebody, in a thread of their choice, must call the function. By default
                callbacks run on the loop.
            rosout: whether to publish /rosout and provide the logger services.
            host: address to listen at; loopback by default.
        """
        self.name = canonical_name("/" + join_names(namespace, name).lstrip("/"))
        self.loop = loop
        self.master_uri = master_uri or master_uri_from_env()
        self.clock: Clock = clock or WallClock()
        self.deliver = deliver
        self.profile = NOETIC
        """How the distribution behaves that its graph is."""
        self.loggers = Loggers.of_rospy()
        self.quiet_log: TextIO | None = None
        self.closed = asyncio.Event()
        """Set when the node has shut down; awaited on the loop."""
        self._remappings = {
            resolve_name(a, self.name): resolve_name(b, self.name) for a, b in (remappings or {}).items()
        }
        self._params = dict(params or {})
        self._address = server_address(host)
        self._slave = Slave(self, self._address)
        self._lock = threading.Lock()
        self._publishers: dict[str, Publisher] = {}
        self._subscriptions: dict[str, list[Subscription]] = {}
        self._publisher_uris: dict[str, list[str]] = {}
        self._services: dict[str, Service] = {}
        self._leaving: set[tuple[str, str]] = set()
        """What the master has still to be told that it has ended."""
        self._noted = Noted()
        self.watched: dict[str, list[ParamCallback]] = {}
        self._rosout: Publisher | None = None
        self._wants_rosout = rosout
        self._errands = Errands(loop, log=self)
        self._listens = asyncio.Event()
        self._params_told = asyncio.Event()
        self._on_shutdown: list[Callable[[str], None]] = []
        self._is_down = False
        self._has_begun = False
        self.loop.call_soon(self._begin)

    # -- who it is

    @property
    def uri(self) -> str:
        """Address of its XML-RPC interface; empty before it has started."""
        return self._slave.uri

    @property
    def is_shut_down(self) -> bool:
        """Whether it has begun to shut down."""
        return self._is_down

    @property
    def remappings(self) -> Mapping[str, str]:
        """Global name → the global name that it means."""
        return self._remappings

    def resolve(self, name: str) -> str:
        """Return the global name this node means by `name`, remapped."""
        return resolve_name(name, self.name, self._remappings)

    # -- topics and services: any thread, no waiting

    def advertise(
        self,
        topic: str,
        type_name: str,
        *,
        latch: bool = False,
        queue_size: int | None = 10,
        on_connect: Callable[[Publisher], None] | None = None,
        foreign: tuple[str, str] | None = None,
    ) -> Publisher:
        """Publish a topic; a second call for the same topic returns the same publisher.

        Args:
            topic: resolved and remapped.
            type_name: such as 'geometry_msgs/Twist'.
            latch: whether new subscribers get the last message.
            queue_size: how many messages wait for a subscriber that reads too slowly; None: any number.
            on_connect: called on the loop whenever a subscriber has connected.
            foreign: (md5 sum, definition) of a type that need not be known here; messages are given as bytes.

        Raises:
            MessageError: no such type, or the topic is already published with another.
        """
        name = self.resolve(topic)
        if foreign is None:
            self.messages.md5(type_name)
        with self._lock:
            there = self._publishers.get(name)
            if there is not None:
                if there.type != type_name:
                    raise MessageError(f"{self.name} publishes {name} as {there.type}, not as {type_name}")
                self._noted.add(there)
                return there
            publisher = Publisher(
                self, name, type_name, latch=latch, queue_size=queue_size, on_connect=on_connect, foreign=foreign
            )
            self._publishers[name] = publisher
        self._noted.add(publisher)
        for listener in self.loop.on_publisher:
            self.loop.call_soon(lambda listener=listener: listener(publisher))
        self._errands.add(lambda: self._tell("registerPublisher", name, type_name, self.uri))
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
            self, name, type_name, callback, queue_size=queue_size, tcp_nodelay=tcp_nodelay, on_loop=on_loop
        )
        with self._lock:
            self._subscriptions.setdefault(name, []).append(subscription)
        self._noted.add(subscription)
        self._errands.add(lambda: self._listen(name, type_name))
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
        service = Service(self, full, type_name, handler)
        with self._lock:
            self._services[full] = service
        self._noted.add(service)
        self._errands.add(lambda: self._provide(full))
        return service

    def noting(self) -> AbstractContextManager[list[End]]:
        """Note what this thread has the node advertise, subscribe or provide meanwhile."""
        return self._noted.gather()

    def unregister_publisher(self, publisher: Publisher) -> None:
        """Stop publishing a topic."""
        with self._lock:
            if self._publishers.get(publisher.topic) is not publisher:
                return
            del self._publishers[publisher.topic]
        self.loop.call_soon(publisher.close)
        self._leave("unregisterPublisher", publisher.topic)

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
            self._leave("unregisterSubscriber", subscription.topic)

    def unregister_service(self, service: Service) -> None:
        """Stop providing a service."""
        with self._lock:
            if self._services.get(service.name) is not service:
                return
            del self._services[service.name]
        self.loop.call_soon(service.close)
        self._leave("unregisterService", service.name)

    def _leave(self, method: str, name: str) -> None:
        """Have the master told; if the node shuts down before, by then."""
        self._leaving.add((method, name))

        async def leave() -> None:
            await self._farewell(method, name)
            self._leaving.discard((method, name))

        self._errands.add(leave)

    async def params_told(self) -> None:
        """Wait until the parameters this node was made with are set, or nobody is there to take them."""
        if self._params and not self._is_down:
            await self._params_told.wait()

    async def listens(self) -> None:
        """Wait until the node has an address, or never will."""
        if not self._is_down:
            await self._listens.wait()

    # -- the end, and waiting for the beginning: on the loop

    async def ready(self) -> None:
        """Wait until everything asked for so far is registered at the master."""
        await self._errands.done()

    async def linked(self) -> None:
        """Wait until every subscription hears the publishers there are, or knows that they do not answer."""
        await self.ready()
        while not all(s.is_settled for subscriptions in self._subscriptions.values() for s in subscriptions):
            await asyncio.sleep(_LINK_S)

    def on_shutdown(self, callback: Callable[[str], None]) -> None:
        """Have a function called, on the loop and with the reason, when this node is told to shut down."""
        self._on_shutdown.append(callback)

    async def shutdown(self) -> None:
        """Unregister everything and drop every peer."""
        if self._is_down:
            await self.closed.wait()
            return
        self._is_down = True
        if self._has_begun:
            await self._listens.wait()  # a server caught half made would stay open
        await self._errands.end()
        if self.uri:
            with contextlib.suppress(TimeoutError):
                async with asyncio.timeout(_FAREWELL_S):
                    await self._unregister_all()
        self.loop.members.discard(self)
        self.loop.nodes.pop(self.uri, None)
        for publisher in self._publishers.values():
            publisher.close()
        for subscriptions in self._subscriptions.values():
            for subscription in subscriptions:
                subscription.close()
        for service in self._services.values():
            service.close()
        await self._slave.stop()
        self.closed.set()

    async def _unregister_all(self) -> None:
        ended = {("unregisterService", name) for name in self._services} | self._leaving
        ended |= {("unregisterSubscriber", topic) for topic in self._subscriptions}
        ended |= {("unregisterPublisher", topic) for topic in self._publishers}
        farewells = [self._farewell(method, name) for method, name in ended]
        farewells += [self._tell("unsubscribeParam", self.uri, name) for name in self.watched]
        await asyncio.gather(*farewells, return_exceptions=True)

    def asked_to_shut_down(self, reason: str) -> None:
        """Obey the master or another node."""
        if self._is_down:
            return
        self.log_warn(f"shutdown request: {reason}")
        for callback in self._on_shutdown:
            callback(reason)
        self.loop.spawn(self.shutdown())

    # -- inside

    def _begin(self) -> None:
        if self._is_down or self.loop.is_ending:
            return
        self._has_begun = True
        self.loop.members.add(self)
        self._errands.begin(self._start)

    async def _start(self) -> None:
        try:
            await self._slave.start()
        finally:
            self._listens.set()
        self.loop.nodes[self.uri] = self
        if self._address.warning:
            self.log_warn(self._address.warning)
        for name, value in self._params.items():
            await self._errands.insist(lambda name=name, value=value: self._set_own(name, value))
        self._params_told.set()
        if self._wants_rosout and self.name != "/rosout":  # that one would gather its own log for ever
            self._rosout = self.advertise("/rosout", "rosgraph_msgs/Log", queue_size=100)
        if self._wants_rosout:
            self.advertise_service("~get_loggers", "roscpp/GetLoggers", self._get_loggers)
            self.advertise_service("~set_logger_level", "roscpp/SetLoggerLevel", self._set_logger_level)

    async def _set_own(self, name: str, value: Any) -> None:
        try:
            await self.set_param(f"~{name}", value)
        except MasterUnreachableError:
            self._params_told.set()  # whoever waits for them learns the reason by asking
            raise

    async def _farewell(self, method: str, name: str) -> None:
        await self._tell(method, name, self._slave.service_uri if method == "unregisterService" else self.uri)

    async def _tell(self, method: str, *arguments: object) -> None:
        await self.ask(method, *arguments)

    async def _provide(self, service: str) -> None:
        await self.ask("registerService", service, self._slave.service_uri, self.uri)
        self.loop.tell_news()

    async def _listen(self, topic: str, type_name: str) -> None:
        uris = await self.ask("registerSubscriber", topic, type_name, self.uri)
        self.publishers_changed(topic, [str(uri) for uri in uris])

    def _get_loggers(self, request: Message) -> dict[str, Any]:
        del request
        return {"loggers": [{"name": name, "level": level} for name, level in self.loggers.levels()]}

    def _set_logger_level(self, request: Message) -> dict[str, Any]:
        try:
            self.loggers.set(request.logger, request.level.lower())
        except ValueError as error:
            raise ServiceError(str(error)) from None
        return {}
