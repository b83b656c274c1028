"""A node: who it is, how it begins and how it ends.

What it does between is in its other parts: `NodeEndpoints` (topics and services), `NodeMasterCalls` (parameters, calls
of services) and `NodeLog`. Registering returns at once, from any thread. Whatever needs an answer is a coroutine of the
loop.
"""

import asyncio
import contextlib
from collections.abc import Callable, Mapping
from typing import Any, Self, TextIO

from trundle.names import canonical_name, join_names, resolve_name

from ..distro import NOETIC
from ..errors import MasterUnreachableError
from ..transport.network import master_uri_from_env, server_address
from .clock import Clock, WallClock
from .endpoints import NodeEndpoints
from .loggers import Loggers
from .loop import GraphLoop
from .master_calls import ParamCallback
from .publisher import Publisher
from .registration_queue import RegistrationQueue
from .rosout import NodeLog
from .slave import Slave

_FAREWELL_S = 1.0
"""How long unregistering may take: a whole program must end within two seconds of Ctrl-C."""
_LINK_S = 0.01


class Node(NodeEndpoints, NodeLog):
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
        super().__init__()
        self.name = canonical_name("/" + join_names(namespace, name).lstrip("/"))
        self.loop = loop
        self.master_uri = master_uri or master_uri_from_env()
        self.clock: Clock = clock or WallClock()
        self.deliver = deliver
        self.profile = NOETIC
        """How the distribution behaves that its graph is."""
        self.loggers = Loggers.for_rospy()
        self.quiet_log: TextIO | None = None
        self.closed = asyncio.Event()
        """Set when the node has shut down; awaited on the loop."""
        self.written_remappings = dict(remappings or {})
        self._remappings = {
            resolve_name(a, self.name): resolve_name(b, self.name) for a, b in self.written_remappings.items()
        }
        self._params = dict(params or {})
        self._address = server_address(host)
        self._slave = Slave(self, self._address)
        self.watched: dict[str, list[ParamCallback]] = {}
        self._rosout: Publisher | None = None
        self._wants_rosout = rosout
        self._registrations = RegistrationQueue(loop, log=self)
        self._listening = asyncio.Event()
        self._params_set = asyncio.Event()
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

    # -- waiting for the beginning, and the end: on the loop

    async def wait_params(self) -> None:
        """Wait until the parameters this node was made with are set, or nobody is there to take them."""
        if self._params and not self._is_down:
            await self._params_set.wait()

    async def wait_listening(self) -> None:
        """Wait until the node has an address, or never will."""
        if not self._is_down:
            await self._listening.wait()

    async def wait_registered(self) -> None:
        """Wait until everything asked for so far is registered at the master."""
        await self._registrations.wait_done()

    async def wait_connected(self) -> None:
        """Wait until every subscription hears the publishers there are, or knows that they do not answer."""
        await self.wait_registered()
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
            await self._listening.wait()  # a server caught half made would stay open
        await self._registrations.close()
        if self.uri:
            with contextlib.suppress(TimeoutError):
                async with asyncio.timeout(_FAREWELL_S):
                    await self._unregister_all()
        self.loop.members.discard(self)
        self.loop.nodes.pop(self.uri, None)
        self._close_all()
        await self._slave.stop()
        self.closed.set()

    def request_shutdown(self, reason: str) -> None:
        """Obey the master or another node."""
        if self._is_down:
            return
        self.log_warn(f"shutdown request: {reason}")
        for callback in self._on_shutdown:
            callback(reason)
        self.loop.spawn(self.shutdown())

    # -- inside

    @property
    def _node(self) -> Self:
        return self

    def _begin(self) -> None:
        if self._is_down or self.loop.is_ending:
            return
        self._has_begun = True
        self.loop.members.add(self)
        self._registrations.start(self._start)

    async def _start(self) -> None:
        try:
            await self._slave.start()
        finally:
            self._listening.set()
        self.loop.nodes[self.uri] = self
        if self._address.warning:
            self.log_warn(self._address.warning)
        for name, value in self._params.items():
            await self._registrations.retry(lambda name=name, value=value: self._set_own(name, value))
        self._params_set.set()
        if self._wants_rosout and self.name != "/rosout":  # that one would gather its own log for ever
            self._rosout = self.advertise("/rosout", "rosgraph_msgs/Log", queue_size=100)
        if self._wants_rosout:
            self.advertise_service("~get_loggers", "roscpp/GetLoggers", self._get_loggers)
            self.advertise_service("~set_logger_level", "roscpp/SetLoggerLevel", self._set_logger_level)

    async def _set_own(self, name: str, value: Any) -> None:
        try:
            await self.set_param(f"~{name}", value)
        except MasterUnreachableError:
            self._params_set.set()  # whoever waits for them learns the reason by asking
            raise
