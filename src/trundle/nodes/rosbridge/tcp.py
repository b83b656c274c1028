"""rosbridge_tcp: the rosbridge protocol as JSON objects that follow each other in a TCP connection."""

import asyncio
import contextlib
import itertools

from trundle.diagnostics import UsageError
from trundle.page import SendBuffer
from trundle.parameters import ParamError, RosParameters
from trundle.ros import Node

from ..host import NodeHost
from ..web_access import WebAddress, read_web_address
from .client_list import ClientList
from .errors import RosbridgeError
from .object_splitter import ObjectSplitter
from .server_settings import apply_arguments, read_options
from .session import Session
from .shared import Shared

_PORT = 9090
_MAX_CLIENTS = 100
_CHUNK = 1024 * 1024


class RosbridgeTcp:
    """Server of the rosbridge protocol, version 2, over TCP.

    Parameters as in rosbridge_server; other machines are served only with allowed_origins: "*".
    """

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del host
        self._node = node
        self._arguments = arguments
        self._numbers = itertools.count()
        self._tasks: set[asyncio.Task[None]] = set()

    async def run(self) -> int:
        """Serve until cancelled."""
        node = self._node
        try:
            tree = apply_arguments(await node.params.get("~", {}), self._arguments)
            settings = RosParameters(tree, node.name)
            options = read_options(settings)
            address = read_web_address(settings, port=_PORT, address=settings.text("host", ""))
            _check_public(address, node.name)
        except UsageError as error:
            node.log.fatal(str(error))
            return 1
        self._shared = Shared(node, options)
        self._clients = ClientList(node)
        try:
            listening = address.listen()
        except OSError as error:
            node.log.fatal(f"{address.host}:{address.port}: {error.strerror or error}; set ~port to another")
            return 1
        server = await asyncio.start_server(self._accept, sock=listening)
        try:
            node.log.info(f"Rosbridge TCP server started on port {listening.getsockname()[1]}")
            await node.params.set("~actual_port", int(listening.getsockname()[1]))
            await node.closed.wait()
        finally:
            server.close()
            for task in self._tasks:
                task.cancel()
            if self._tasks:
                await asyncio.wait(self._tasks)
        return 0

    async def _accept(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        task = asyncio.current_task()
        if task is None or len(self._tasks) >= _MAX_CLIENTS:
            writer.close()
            return
        self._tasks.add(task)
        number = next(self._numbers)
        outgoing = SendBuffer()
        session = Session(number, self._shared, outgoing)
        sending = asyncio.create_task(_send_all(outgoing, writer))
        self._clients.add(number, str(writer.get_extra_info("peername", ("",))[0]))
        try:
            with contextlib.suppress(ConnectionError):
                await self._receive_all(reader, session)
        except asyncio.CancelledError:
            pass  # the node ends
        finally:
            session.close()
            self._clients.remove(number)
            sending.cancel()
            await asyncio.wait((sending,))
            writer.close()
            self._tasks.discard(task)

    async def _receive_all(self, reader: asyncio.StreamReader, session: Session) -> None:
        """Handle objects until the client leaves, or sends what is none: a browser's requests begin otherwise."""
        splitter = ObjectSplitter()
        while data := await reader.read(_CHUNK):
            try:
                texts = splitter.feed(data)
            except RosbridgeError as error:
                self._node.log.warn(f"a client is disconnected: {error}")
                return
            for text in texts:
                await session.receive(text)


def _check_public(address: WebAddress, name: str) -> None:
    if address.is_public and not address.is_open:
        raise ParamError(
            f"parameter {name}/host: the protocol over TCP has no token; at {address.host} every machine could "
            "drive the robot. Set ~allowed_origins to '*' if that is wanted, or use rosbridge_websocket"
        )


async def _send_all(outgoing: SendBuffer, writer: asyncio.StreamWriter) -> None:
    with contextlib.suppress(ConnectionError):
        while True:
            message = await outgoing.get()
            writer.write(message.encode() if isinstance(message, str) else message)
            await writer.drain()
