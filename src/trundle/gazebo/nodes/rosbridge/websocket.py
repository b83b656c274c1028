"""rosbridge_websocket: the graph for web pages and programs, as JSON over WebSockets."""

import itertools
import ssl
from typing import TYPE_CHECKING

from trundle.base.diagnostics import UsageError
from trundle.base.http.web_server import SocketClient, SocketOptions, WebServer
from trundle.robots.parameters import RosParameters
from trundle.ros import Node

from ..host import NodeHost
from ..web_access import WebAddress, read_web_address
from .client_list import ClientList
from .server_settings import apply_arguments, read_options
from .session import Session
from .shared import Shared

if TYPE_CHECKING:
    import socket

_PORT = 9090


class RosbridgeWebsocket:
    """Server of the rosbridge protocol, version 2, over WebSockets; subscriptions as JSON, PNG or CBOR.

    Parameters as in rosbridge_server, and allowed_origins, allowed_hosts and token, which restrict the clients.
    """

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del host
        self._node = node
        self._arguments = arguments
        self._numbers = itertools.count()

    async def run(self) -> int:
        """Serve until cancelled."""
        node = self._node
        try:
            tree = apply_arguments(await node.params.get("~", {}), self._arguments)
            settings = RosParameters(tree, node.name)
            options = read_options(settings)
            address = read_web_address(settings, port=_PORT, null_origin="websocket_null_origin")
            certificate = _certificate(settings)
            retry_s = settings.number("retry_startup_delay", 2.0, minimum=0.1)
            ping_s = settings.number("websocket_ping_interval", 0.0, minimum=0.0)
            compresses = settings.flag("use_compression", default=False)
        except UsageError as error:
            node.log.fatal(str(error))
            return 1
        self._shared = Shared(node, options)
        self._clients = ClientList(node)
        socket_ = await self._listen(address, retry_s)
        port = int(socket_.getsockname()[1])
        sockets = SocketOptions(serve=self._serve, ping_s=ping_s or None, compresses=compresses)
        server = WebServer(address.access("rosbridge", port), {}, sockets=sockets)
        await server.start(socket_, certificate)
        try:
            await node.params.set("~actual_port", port)
            scheme = "ws" if certificate is None else "wss"
            node.log.info(f"Rosbridge WebSocket server started at {address.url(scheme, port)}")
            if address.warning is not None:
                node.log.warn(address.warning)
            await node.closed.wait()
        finally:
            await server.close()
        return 0

    async def _listen(self, address: WebAddress, retry_s: float) -> "socket.socket":
        """Retry until the port is free."""
        while True:
            try:
                return address.listen()
            except OSError as error:
                address_text = f"{address.host}:{address.port}"
                reason = error.strerror or str(error)
                self._node.log.warn(f"Unable to start server at {address_text}: {reason}. Retrying in {retry_s:g}s.")
                await self._node.clock.sleep(retry_s)

    async def _serve(self, client: SocketClient) -> None:
        number = next(self._numbers)
        session = Session(number, self._shared, client.outgoing)
        self._clients.add(number, client.peer)
        try:
            while (message := await client.receive()) is not None:
                await session.receive(message)
        finally:
            session.close()
            self._clients.remove(number)


def _certificate(settings: RosParameters) -> ssl.SSLContext | None:
    """Return the TLS context of certfile and keyfile; None: neither is set.

    Raises:
        UsageError: the files cannot be read.
    """
    certificate, key = settings.text("certfile", ""), settings.text("keyfile", "")
    if not certificate and not key:
        return None
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
    try:
        context.load_cert_chain(certificate, key or None)
    except (OSError, ssl.SSLError) as error:
        parameters = f"parameters {settings.namespace}/certfile and keyfile"
        raise UsageError(f"{parameters}: no certificate and key in {certificate!r}, {key!r}: {error}") from None
    return context
