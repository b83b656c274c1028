"""A node of the graph.

Parts: `endpoints`, `params`, `log` and `master`. Registration returns at once and is thread-safe; methods that await an
answer are coroutines on the loop.
"""

import asyncio
import contextlib
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

from trundle.robots.names import canonical_name, join_names, resolve_name

from ..distro import NOETIC
from ..messages.raw_message import ANY_TYPE, Message, TypedMessage
from ..transport.network import master_uri_from_env, server_address
from .callback_dispatch import Deliver
from .clock import Clock, WallClock
from .endpoints import NodeEndpoints
from .local_graph import LocalNode
from .loop import GraphLoop
from .master_client import MasterClient
from .master_watch import watch_master
from .node_log import NodeLog
from .param_client import ParamClient
from .publisher import Publisher
from .registration_queue import RegistrationQueue
from .service import Service, ServiceCallback
from .service_client import call_service, wait_for_service
from .slave import Slave
from .subscription import Callback, Subscription

if TYPE_CHECKING:
    from ..message_types import Time
    from ..messages.message_library import Messages

_UNREGISTER_S = 1.0
"""Timeout of unregistering at another process' master: a program must end within two seconds of Ctrl-C."""
_LOCAL_UNREGISTER_S = 10.0
"""Timeout of unregistering at a master of this process, which cannot answer when it is out of file descriptors."""
_CONNECT_POLL_S = 0.01


class Node:
    """One node of the graph."""

    def __init__(
        self,
        name: str,
        *,
        loop: GraphLoop,
        master_uri: str | None = None,
        namespace: str = "/",
        remappings: Mapping[str, str] | None = None,
        params: Mapping[str, object] | None = None,
        clock: Clock | None = None,
        deliver: Deliver | None = None,
        deliver_call: Deliver | None = None,
        rosout: bool = True,
        host: str | None = None,
        ports: tuple[int, int] = (0, 0),
        log: NodeLog | None = None,
    ) -> None:
        """Create and start a node; returns at once.

        Args:
            name: base name such as 'driver', or a global name.
            loop: loop that runs the node.
            master_uri: ROS_MASTER_URI by default.
            namespace: namespace of relative names.
            remappings: name → name, as on a command line.
            params: private parameters, set before anything else.
            clock: ROS time; wall time by default.
            deliver: called on the loop with a function per message and request, which must be called later, in any
                thread; must not block. By default, callbacks run on the loop.
            deliver_call: as `deliver`, for requests; `deliver` by default.
            rosout: True: publish /rosout and advertise the logger services.
            host: address to bind; loopback by default.
            ports: ports of the slave API and of TCPROS; 0: any free port.
            log: log of the node; stderr and /rosout by default.
        """
        self.name = canonical_name("/" + join_names(namespace, name).lstrip("/"))
        self.loop = loop
        self.master_uri = master_uri or master_uri_from_env()
        self.clock: Clock = clock or WallClock()
        self.deliver = deliver
        self._deliver_call = deliver_call
        self.profile = NOETIC
        """Distribution of the graph."""
        self.closed = asyncio.Event()
        """Set after shutdown; awaited on the loop."""
        self.written_remappings = dict(remappings or {})
        """Remappings as written, unresolved."""
        self._remappings = {
            resolve_name(a, self.name): resolve_name(b, self.name) for a, b in self.written_remappings.items()
        }
        self.log = log or NodeLog(self.name, lambda: self.clock)
        self.master = MasterClient(self.master_uri, self.name, loop.work)
        self._registrations = RegistrationQueue(loop, log=self.log)
        self.params = ParamClient(self, params or {})
        self.endpoints = NodeEndpoints(self, self._registrations)
        self._address = server_address(host)
        self._slave = Slave(
            self, self.endpoints, self.params, self._address, on_shutdown=self.request_shutdown, ports=ports
        )
        self._publishes_rosout = rosout
        self._listening = asyncio.Event()
        self._on_shutdown: list[Callable[[str], None]] = []
        self._is_down = False
        self._is_started = False
        self._master_watch: asyncio.Task[None] | None = None
        self.loop.call_soon(self._begin)

    # -- identity

    @property
    def uri(self) -> str:
        """URI of the slave API; '' before it listens."""
        return self._slave.uri

    @property
    def service_uri(self) -> str:
        """rosrpc URI of the node's services."""
        return self._slave.service_uri

    @property
    def is_shut_down(self) -> bool:
        """True once shutdown has begun."""
        return self._is_down

    @property
    def remappings(self) -> Mapping[str, str]:
        """Global name → remapped global name."""
        return self._remappings

    @property
    def deliver_call(self) -> Deliver | None:
        """Schedules callbacks of requests."""
        return self._deliver_call or self.deliver

    def resolve(self, name: str) -> str:
        """Resolve and remap a name to a global name."""
        return resolve_name(name, self.name, self._remappings)

    @property
    def messages(self) -> "Messages":
        """Message types of the loop."""
        return self.loop.messages

    def new(self, type_name: str, fields: object = None) -> Message:
        """Build a message; 'now' and 'auto' are this node's ROS time. See `Messages.new`."""
        return self.messages.new(type_name, fields, now_ns=self.clock.now_ns())

    def stamp(self) -> "Time":
        """ROS time as a `time` value."""
        return self.messages.stamp(self.clock.now_ns())

    # -- topics and services

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
        """Advertise a topic; repeated calls return the same publisher.

        Args:
            topic: resolved and remapped.
            type_name: such as 'geometry_msgs/Twist'.
            latch: True: new subscribers get the last message.
            queue_size: messages queued per slow subscriber; None: unlimited.
            on_connect: called on the loop with each new subscriber.
            raw_type: (md5 sum, definition) of a possibly unknown type; messages are then published as bytes.

        Raises:
            MessageError: unknown type, or the topic is already published with another.
        """
        name = self.resolve(topic)
        if raw_type is None:
            self.messages.md5(type_name)
        return self.endpoints.add_publisher(
            name,
            type_name,
            lambda: Publisher(
                self,
                name,
                type_name,
                latch=latch,
                queue_size=queue_size,
                on_connect=on_connect,
                raw_type=raw_type,
                unregister=self.endpoints.remove_publisher,
            ),
        )

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
            callback: function or coroutine function of the message; its exceptions are logged.
            queue_size: messages queued for slow callbacks; None: unlimited.
            tcp_nodelay: True: request TCP_NODELAY from publishers.
            on_loop: True: run the callback on the loop, even if the node has `deliver`.

        Raises:
            MessageError: unknown type.
        """
        name = self.resolve(topic)
        if type_name != ANY_TYPE:
            self.messages.md5(type_name)
        subscription = Subscription(
            self,
            name,
            type_name,
            callback,
            queue_size=queue_size,
            tcp_nodelay=tcp_nodelay,
            on_loop=on_loop,
            unregister=self.endpoints.remove_subscription,
        )
        self.endpoints.add_subscription(subscription)
        return subscription

    def advertise_service(self, name: str, type_name: str, handler: ServiceCallback) -> Service:
        """Advertise a service.

        Args:
            name: resolved and remapped.
            type_name: such as 'std_srvs/SetBool'.
            handler: function or coroutine function of the request; returns the response or its fields as a dictionary,
                or raises ServiceError for failure. A coroutine function runs on the loop, even if the node has
                `deliver`.

        Raises:
            MessageError: unknown type.
        """
        service = Service(self, self.resolve(name), type_name, handler, unregister=self.endpoints.remove_service)
        self.endpoints.add_service(service)
        return service

    async def call_service(
        self,
        name: str,
        type_name: str,
        request: TypedMessage | Mapping[str, object] | None = None,
        *,
        timeout_s: float | None = None,
    ) -> Message:
        """Call a service; without a timeout, until it answers or the connection breaks.

        Raises:
            ServiceError: the service is not available, fails or times out.
            MessageError: unknown type, or a request that does not fit it.
        """
        return await call_service(self, self.resolve(name), type_name, request, timeout_s)

    async def wait_for_service(self, name: str, timeout_s: float | None = None) -> None:
        """Wait until a service is available.

        Raises:
            ServiceError: timeout.
        """
        await wait_for_service(self, self.resolve(name), timeout_s)

    def register_again(self) -> None:
        """Register everything, at a master that was started again."""
        self.params.register_again(self._registrations)
        self.endpoints.register_again()

    # -- startup and shutdown: on the loop

    async def wait_listening(self) -> None:
        """Wait until the node listens, or is shut down."""
        if not self._is_down:
            await self._listening.wait()

    async def wait_registered(self) -> None:
        """Wait until everything added so far is registered at the master.

        Raises:
            RosError: the node could not start, such as for lack of file descriptors.
            OSError: the system refused it a socket.
        """
        await self._registrations.wait_done()

    async def wait_connected(self) -> None:
        """Wait until every subscription is connected to its publishers, or has reported that they are unreachable."""
        await self.wait_registered()
        while not all(subscription.is_settled for subscription in self.endpoints.subscriptions):
            await asyncio.sleep(_CONNECT_POLL_S)

    def on_shutdown(self, callback: Callable[[str], None]) -> None:
        """Register a function to be called on the loop, with the reason, on a shutdown request."""
        self._on_shutdown.append(callback)

    async def shutdown(self) -> None:
        """Unregister everything and close all connections."""
        if self._is_down:
            await self.closed.wait()
            return
        self._is_down = True
        try:
            await self._disconnect()
        finally:
            self.closed.set()

    async def _disconnect(self) -> None:
        if self._is_started:
            await self._listening.wait()  # a partly created server would stay open
        if self._master_watch is not None:
            self._master_watch.cancel()
        await self._registrations.close()
        if self.uri:
            is_local = self.master_uri in self.loop.local.masters
            with contextlib.suppress(TimeoutError):
                async with asyncio.timeout(_LOCAL_UNREGISTER_S if is_local else _UNREGISTER_S):
                    calls = [*self.endpoints.unregister_all(), *self.params.unwatch_all()]
                    await asyncio.gather(*calls, return_exceptions=True)
        self.loop.local.members.discard(self)
        self.loop.local.nodes.pop(self.uri, None)
        self.endpoints.close()
        await self._slave.stop()

    def request_shutdown(self, reason: str) -> None:
        """Handle a shutdown request of the master or another node."""
        if self._is_down:
            return
        self.log.warn(f"shutdown request: {reason}")
        for callback in self._on_shutdown:
            callback(reason)
        self.loop.spawn(self.shutdown())

    # -- internals

    def _begin(self) -> None:
        if self._is_down or self.loop.is_ending:
            return
        self._is_started = True
        self.loop.local.members.add(self)
        self._registrations.start(self._start)

    async def _start(self) -> None:
        try:
            await self._slave.start()
        finally:
            self._listening.set()
        self.loop.local.nodes[self.uri] = LocalNode(
            name=self.name, closed=self.closed, find_publisher=self.endpoints.publisher
        )
        if self._address.warning:
            self.log.warn(self._address.warning)
        if self.master_uri not in self.loop.local.masters:
            self._master_watch = asyncio.create_task(watch_master(self, self))
        await self.params.set_private(self._registrations)
        if self._publishes_rosout:
            self._start_rosout()

    def _start_rosout(self) -> None:
        if self.name != "/rosout":  # /rosout would aggregate its own messages endlessly
            rosout = self.advertise("/rosout", "rosgraph_msgs/Log", queue_size=100)
            self.log.publish_on(rosout, lambda: [publisher.topic for publisher in self.endpoints.publishers])
        # Coroutines, so that the loop answers: they concern the node, not the objects of its callbacks.
        self.advertise_service("~get_loggers", "roscpp/GetLoggers", self.log.get_loggers)
        self.advertise_service("~set_logger_level", "roscpp/SetLoggerLevel", self.log.set_logger_level)
