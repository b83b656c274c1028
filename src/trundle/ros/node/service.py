"""Services: a provider's connections, and the client's side of one call."""

import asyncio
import contextlib
import inspect
import struct
from collections.abc import Awaitable, Callable
from typing import TYPE_CHECKING, Any

from ..errors import MessageError, RosError, ServiceError, WireError
from ..messages.messages import Message, Messages, ServiceType
from ..transport.headers import MAX_HEADER_BYTES, MAX_MESSAGE_BYTES, check_md5, decode_header, encode_header, frame
from ..transport.tcpros import FrameProtocol
from ..xmlrpc.http import host_and_port
from .callback_dispatch import run_on_callback_thread

if TYPE_CHECKING:
    from .node import Node

ServiceCallback = Callable[[Message], "Awaitable[Message | dict[str, Any]] | Message | dict[str, Any]"]
_MAX_WAITING = 64
"""Requests one client may send ahead of the answers; no client library sends more than one."""


class Service:
    """Provides one service of one node; made by `Node.advertise_service`."""

    def __init__(self, node: "Node", name: str, type_name: str, handler: ServiceCallback) -> None:
        self.name = name
        self.type = type_name
        self.kind: ServiceType = node.messages.service(type_name)
        self._node = node
        self._handler = handler
        self._links: dict[FrameProtocol, asyncio.Queue[bytes | memoryview | None]] = {}
        self._tasks: set[asyncio.Task[None]] = set()

    def unregister(self) -> None:
        """Stop providing; any thread."""
        self._node.unregister_service(self)

    # on the loop

    def accept(self, link: FrameProtocol, header: dict[str, str]) -> None:
        """Take a client's connection, or refuse it with the reason the original gives."""
        wanted = header.get("md5sum", "")
        if not check_md5(wanted, self.kind.md5sum):
            peer = header.get("callerid", "unknown")
            link.refuse(f"request from [{peer}]: md5sums do not match: [{wanted}] vs. [{self.kind.md5sum}]")
            return
        link.set_nodelay()
        link.send_header(
            {
                "callerid": self._node.name,
                "service": self.name,
                "type": self.type,
                "md5sum": self.kind.md5sum,
                "request_type": self.kind.request,
                "response_type": self.kind.response,
            }
        )
        if header.get("probe") == "1":
            link.close("only asked")
            return
        requests: asyncio.Queue[bytes | memoryview | None] = asyncio.Queue(_MAX_WAITING)
        self._links[link] = requests
        persistent = header.get("persistent", "0").lower() in ("1", "true")
        task = asyncio.get_running_loop().create_task(self._answer_all(link, requests, persistent))
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)

    def request(self, link: FrameProtocol, data: bytes | memoryview) -> None:
        """Take a request."""
        try:
            self._links[link].put_nowait(data)
        except (KeyError, asyncio.QueueFull):
            raise WireError("more requests than are accepted at once") from None

    def release(self, link: FrameProtocol) -> None:
        """Forget a connection that has ended."""
        if (requests := self._links.pop(link, None)) is not None:
            with contextlib.suppress(asyncio.QueueFull):  # one that is busy looks at the connection itself
                requests.put_nowait(None)

    def close(self) -> None:
        """Drop every client."""
        for task in list(self._tasks):
            task.cancel()
        for link in list(self._links):
            link.close("the service is no longer provided")

    async def _answer_all(
        self, link: FrameProtocol, requests: "asyncio.Queue[bytes | memoryview | None]", persistent: bool
    ) -> None:
        while link.transport is not None and (request := await requests.get()) is not None:
            answer = await self._answer(request)
            link.out.send([(answer,)], None)
            if not persistent:
                link.finish("answered")
                return

    async def _answer(self, data: bytes | memoryview) -> bytes:
        """Answer one request: a byte that says whether it went well, then the response or the error's text."""
        try:
            response = await self._handle(self._node.messages.deserialize(data, self.kind.request))
            if isinstance(response, dict) or response is None:
                response = self._node.new(self.kind.response, response)
            return b"\x01" + frame(self._node.messages.serialize(response))
        except (ServiceError, MessageError) as error:
            return b"\x00" + frame(f"service cannot process request: {error}".encode())
        except Exception as error:
            self._node.log_failure(f"the service {self.name} failed", error)
            return b"\x00" + frame(f"error processing request: {error}".encode())

    async def _handle(self, request: Message) -> Any:
        node = self._node
        if inspect.iscoroutinefunction(self._handler):
            return await self._handler(request)
        result = await run_on_callback_thread(node.deliver, node.loop, lambda: self._handler(request))
        return await result if inspect.isawaitable(result) else result


async def call_service(
    messages: Messages, caller: str, uri: str, name: str, kind: ServiceType, request: Message
) -> Message:
    """Call a service at a provider's address, in the name of the node `caller`.

    Raises:
        ServiceError: the provider refuses or fails, or breaks the connection.
    """
    body = messages.serialize(request)
    try:
        async with _connection(uri) as (reader, writer):
            header = {"callerid": caller, "service": name, "type": kind.type, "md5sum": kind.md5sum}
            writer.write(encode_header(header))
            answer = decode_header(await _read_frame(reader, MAX_HEADER_BYTES))
            if "error" in answer:
                raise ServiceError(f"{name} refuses: {answer['error']}")
            writer.write(frame(body))
            well = await reader.readexactly(1) == b"\x01"
            data = await _read_frame(reader, MAX_MESSAGE_BYTES)
    except (OSError, WireError, asyncio.IncompleteReadError) as error:
        raise ServiceError(f"{name} at {uri} cannot be called: {error or type(error).__name__}") from None
    if not well:
        raise ServiceError(f"service [{name}] responded with an error: {data.decode('utf-8', 'replace')}")
    try:
        return messages.deserialize(data, kind.response)
    except MessageError as error:
        raise ServiceError(f"{name} answers with something else: {error}") from None


async def probe_service(uri: str, name: str, caller: str) -> dict[str, str]:
    """Ask a provider for its header, which names the type.

    Raises:
        ServiceError: the provider is not there.
    """
    try:
        async with asyncio.timeout(5.0), _connection(uri) as (reader, writer):
            writer.write(encode_header({"callerid": caller, "service": name, "md5sum": "*", "probe": "1"}))
            return decode_header(await _read_frame(reader, MAX_HEADER_BYTES))
    except (OSError, RosError, asyncio.IncompleteReadError) as error:
        raise ServiceError(f"{name} at {uri} does not answer: {error or type(error).__name__}") from None


@contextlib.asynccontextmanager
async def _connection(uri: str):
    reader, writer = await asyncio.open_connection(*host_and_port(uri))
    try:
        yield reader, writer
    finally:
        writer.close()


async def _read_frame(reader: asyncio.StreamReader, limit: int) -> bytes:
    (size,) = struct.unpack("<I", await reader.readexactly(4))
    if size > limit:
        raise WireError(f"a frame of {size} bytes is announced, more than is accepted")
    return await reader.readexactly(size)
