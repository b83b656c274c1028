"""Servers of a node: slave API, and the TCPROS port of topics and services."""

import asyncio
import os
import re
from collections.abc import Callable
from functools import partial
from typing import Any, cast

from ..transport.closing_loop import close_server
from ..transport.network import ServerAddress
from ..transport.tcpros import FrameProtocol
from ..transport.unix_sockets import UNIXROS, is_of_this_user, listen_unix
from ..xmlrpc.rpc_methods import Answer, BadArgumentError, Method, answer_call, name_argument
from ..xmlrpc.rpc_server import RpcServer
from .endpoints import NodeEndpoints
from .node_context import NodeContext
from .param_client import ParamClient
from .publisher import Publisher
from .service import Service

_BACKLOG = 512
"""Accept queue: all subscribers of a big launch connect at once, and a rejected one retries after a second."""
_URL = re.compile(r"\w[\w+.-]*://.")
_MAX_PENDING_PEERS = 512
"""Maximum number of connections that have not sent a header yet; beyond it, the oldest is closed."""


class Slave:
    """Slave API and TCPROS server of one node."""

    def __init__(
        self,
        node: NodeContext,
        endpoints: NodeEndpoints,
        params: ParamClient,
        address: ServerAddress,
        *,
        on_shutdown: Callable[[str], None],
        ports: tuple[int, int] = (0, 0),
    ) -> None:
        """`on_shutdown` is called with the reason of a shutdown request; `ports` are the slave API's and TCPROS's."""
        self._ports = ports
        self._node = node
        self._endpoints = endpoints
        self._params = params
        self._on_shutdown = on_shutdown
        self._address = address
        self._rpc = RpcServer(partial(answer_call, self._methods()))
        self._servers: list[asyncio.Server] = []
        self._unix_socket: list[str] = []
        """Name of the Unix socket for local nodes, if supported."""
        self._links: set[_Inbound] = set()
        self._pending_peers: dict[_Inbound, None] = {}
        self.uri = ""
        self.tcp_port = 0

    async def start(self) -> None:
        """Listen on two ports and on a Unix socket."""
        await self._rpc.start(self._address.bind, self._ports[0])
        self.uri = f"http://{self._address.authority(self._rpc.port)}/"
        loop = asyncio.get_running_loop()
        server = await loop.create_server(self._inbound, self._address.bind, self._ports[1], backlog=_BACKLOG)
        self._servers.append(server)
        self.tcp_port = server.sockets[0].getsockname()[1]
        if (listener := listen_unix()) is not None:
            unix_socket, name = listener
            self._servers.append(await loop.create_server(self._inbound, sock=unix_socket, backlog=_BACKLOG))
            self._unix_socket = [name]

    @property
    def service_uri(self) -> str:
        """rosrpc URI of the node's services."""
        return f"rosrpc://{self._address.authority(self.tcp_port)}"

    async def stop(self) -> None:
        """Stop listening and close all connections."""
        for server in self._servers:
            await close_server(server)
        for link in list(self._links):
            link.close("the node shuts down")
        await self._rpc.stop()

    def _inbound(self) -> "_Inbound":
        return _Inbound(self._node, self._endpoints, self._links, self._pending_peers)

    def _methods(self) -> dict[str, Method]:
        node, endpoints = self._node, self._endpoints
        return {
            "getName": (0, "", _reply("", lambda: node.name)),
            "getUri": (0, "", _reply("", lambda: self.uri)),
            "getPid": (0, -1, _reply("", os.getpid)),
            "getMasterUri": (0, "", _reply(node.master_uri, lambda: node.master_uri)),
            "getBusInfo": (0, [], _reply("bus info", endpoints.connections)),
            "getBusStats": (0, [], _reply("", endpoints.statistics)),
            "getPublications": (0, [], _reply("publications", lambda: [[*t] for t in endpoints.published_topics()])),
            "getSubscriptions": (0, [], _reply("subscriptions", lambda: [[*t] for t in endpoints.subscribed_topics()])),
            "publisherUpdate": (2, -1, self._publisher_update),
            "paramUpdate": (2, -1, self._param_update),
            "requestTopic": (2, [], self._request_topic),
            "shutdown": (1, 0, self._shutdown),
        }

    def _shutdown(self, _: str, reason: Any) -> Answer:
        self._on_shutdown(str(reason))
        return 1, "shutdown", 0

    def _publisher_update(self, caller: str, topic: Any, uris: Any) -> Answer:
        name = name_argument("topic", topic, caller)
        if not isinstance(uris, list):
            raise BadArgumentError("ERROR: param [publishers] must be a list")
        for uri in cast("list[Any]", uris):
            if not isinstance(uri, str):
                raise BadArgumentError("ERROR: param [publishers] must be a list of strings")
            if not _URL.match(uri):
                raise BadArgumentError(f"ERROR: param [publishers] does not contain valid URLs [{uri}]")
        self._endpoints.publishers_changed(name, cast("list[str]", uris))
        return 1, "", 0

    def _param_update(self, _: str, key: Any, value: Any) -> Answer:
        if not isinstance(key, str) or not key:
            raise BadArgumentError("ERROR: parameter [parameter_key] must be a non-empty string")
        if not key.startswith("/"):
            raise BadArgumentError("ERROR: parameter [parameter_key] must be a globally referenced name")
        return (1, "", 0) if self._params.notify(key, value) else (-1, "not subscribed", 0)

    def _request_topic(self, caller: str, topic: Any, protocols: Any) -> Answer:
        name = name_argument("topic", topic, caller)
        if not protocols:
            raise BadArgumentError("ERROR: parameter [protocols] must be specified and non-empty")
        if self._endpoints.publisher(name) is None:
            return -1, f"Not a publisher of [{name}]", []
        requested = [p[0] for p in protocols if isinstance(p, list) and p]  # pyright: ignore[reportUnknownVariableType]
        if "TCPROS" not in requested:
            return 0, "no supported protocol implementations", []
        host = self._address.advertise
        return (
            1,
            f"ready on {host}:{self.tcp_port}",
            ["TCPROS", host, self.tcp_port, *(self._unix_socket if UNIXROS in requested else [])],
        )


def _reply(text: str, value: Callable[[], object]) -> Callable[[str], Answer]:
    return lambda _: (1, text, value())


class _Inbound(FrameProtocol):
    """Inbound connection, whose header names a topic or a service."""

    def __init__(
        self,
        node: NodeContext,
        endpoints: NodeEndpoints,
        links: "set[_Inbound]",
        pending_peers: "dict[_Inbound, None]",
    ) -> None:
        super().__init__()
        self._node = node
        self._endpoints = endpoints
        self._links = links
        self._pending_peers = pending_peers
        self._target: Publisher | Service | None = None

    def connected(self) -> None:
        self._links.add(self)
        self._pending_peers[self] = None
        if len(self._pending_peers) > _MAX_PENDING_PEERS:
            next(iter(self._pending_peers)).close("too many connections without a header")
        assert self.transport is not None
        if self.out.is_local and not is_of_this_user(self.transport.get_extra_info("socket")):
            self.close("the peer runs as another user")
        if self._node.is_shut_down:  # the connection was accepted during shutdown
            self.close("the node shuts down")

    def header_received(self, header: dict[str, str]) -> None:
        self._pending_peers.pop(self, None)
        name = header.get("topic", header.get("service"))
        if name is None:
            self.refuse("Missing required 'topic' or 'service' field")
            return
        for field in ("md5sum", "callerid"):
            if field not in header:
                self.refuse(f"Missing required '{field}' field")
                return
        if "topic" in header:
            self._target = self._endpoints.publisher(name)
            role = "publisher of"
        else:
            self._target = self._endpoints.service(name)
            role = "provider of "
        if self._target is None:
            self.refuse(f"[{self._node.name}] is not a {role} [{name}]")
            return
        self._target.accept(self, header)

    def frame_received(self, data: bytes | memoryview) -> None:
        if isinstance(self._target, Service):
            self._target.request(self, data)

    def note_received(self, note: bytes, /) -> None:
        self.out.receive_note(note)
        self.read_through(self._node.loop.selector)

    def drained(self) -> None:
        if isinstance(self._target, Publisher):
            self._target.resume()

    def closed(self, _: str, /) -> None:
        self._links.discard(self)
        self._pending_peers.pop(self, None)
        if self._target is not None:
            self._target.release(self)
