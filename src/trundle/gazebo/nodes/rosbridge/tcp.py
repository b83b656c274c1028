"""rosbridge_tcp: the rosbridge protocol as consecutive JSON objects in a TCP connection."""

import asyncio
import contextlib
import itertools
import json
from secrets import compare_digest

from trundle.base.diagnostics import UsageError
from trundle.base.http.send_buffer import SendBuffer
from trundle.robots.parameters import ParamError, RosParameters
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
_REJECTION_DELAY_S = 1.0
"""Delay before a connection without the token is closed, against guessing."""


class RosbridgeTcp:
    """Server of the rosbridge protocol, version 2, over TCP.

    Parameters as in rosbridge_server, and token: a client then begins with `{"op": "auth", "mac": TOKEN}`. Other
    machines are served only with a token, or with allowed_origins: "*".
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
        self._token = address.token.encode() if address.has_fixed_token and not address.is_open else None
        self._shared = Shared(node, options)
        self._clients = ClientList(node)
        try:
            socket_ = address.listen()
        except OSError as error:
            node.log.fatal(f"{address.host}:{address.port}: {error.strerror or error}; set ~port to another")
            return 1
        server = await asyncio.start_server(self._accept, sock=socket_)
        try:
            node.log.info(f"Rosbridge TCP server started on port {socket_.getsockname()[1]}")
            if address.warning is not None:
                node.log.warn(address.warning)
            await node.params.set("~actual_port", int(socket_.getsockname()[1]))
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
        """Handle objects until the client leaves or sends anything else, such as a browser's request."""
        splitter, has_token = ObjectSplitter(), self._token is None
        while data := await reader.read(_CHUNK):
            try:
                texts = splitter.feed(data)
            except RosbridgeError as error:
                self._node.log.warn(f"a client is disconnected: {error}")
                return
            for text in texts:
                if has_token:
                    await session.receive(text)
                elif compare_digest(_read_token(text), self._token or b""):
                    has_token = True
                else:
                    self._node.log.warn("a client is disconnected: its first message is not the token")
                    await asyncio.sleep(_REJECTION_DELAY_S)
                    return


def _read_token(text: str) -> bytes:
    """Return the token in the first message of a connection; empty: no token."""
    try:
        message = json.loads(text)
    except (ValueError, RecursionError):
        return b""
    is_auth = isinstance(message, dict) and message.get("op") == "auth"
    return str(message.get("mac", "")).encode("utf-8", "surrogatepass") if is_auth else b""


def _check_public(address: WebAddress, name: str) -> None:
    if address.is_public and not address.is_open and not address.has_fixed_token:
        raise ParamError(
            f"parameter {name}/host: without a token, every machine could drive the robot at {address.host}. "
            "Set ~token, or ~allowed_origins to '*' to allow that"
        )


async def _send_all(outgoing: SendBuffer, writer: asyncio.StreamWriter) -> None:
    with contextlib.suppress(ConnectionError):
        while True:
            message = await outgoing.get()
            writer.write(message.encode() if isinstance(message, str) else message)
            await writer.drain()
