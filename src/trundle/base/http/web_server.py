"""Web server of a node: pages, streams and WebSockets on one port, behind `Access`."""

import asyncio
import contextlib
import logging
import socket
import ssl
from collections.abc import AsyncGenerator, Awaitable, Callable, Mapping
from dataclasses import dataclass, field

from aiohttp import ClientConnectionError, WSMsgType, web

from .access import Access, PageRequest
from .guard import Guard
from .send_buffer import SendBuffer

_MAX_MESSAGE_BYTES = 64 * 1024 * 1024
"""Maximum length of a client's message."""
_SHUTDOWN_S = 0.2
_NO_SNIFFING = {"X-Content-Type-Options": "nosniff", "Referrer-Policy": "no-referrer"}


@dataclass(frozen=True, slots=True, kw_only=True)
class Reply:
    """Response to a request: a body, or a stream of parts until the client disconnects."""

    status: int = 200
    content_type: str = "text/plain; charset=utf-8"
    body: bytes = b""
    parts: AsyncGenerator[bytes, None] | None = None
    fields: Mapping[str, str] = field(default_factory=dict[str, str])


Handler = Callable[[Mapping[str, str]], Awaitable[Reply]]
"""Answers a GET request from its query."""


class SocketClient:
    """WebSocket of a client."""

    def __init__(self, web_socket: web.WebSocketResponse, peer: str) -> None:
        self._web_socket = web_socket
        self.peer = peer
        """Address of the client."""
        self.outgoing = SendBuffer()
        """Messages to the client."""

    async def receive(self) -> str | bytes | None:
        """Wait for a message; None: the client has disconnected."""
        message = await self._web_socket.receive()
        return message.data if message.type in (WSMsgType.TEXT, WSMsgType.BINARY) else None

    async def send_all(self) -> None:
        """Send the messages of `outgoing`, until cancelled or the client disconnects."""
        with contextlib.suppress(ClientConnectionError, ConnectionError):
            while True:
                message = await self.outgoing.get()
                if isinstance(message, str):
                    await self._web_socket.send_str(message)
                else:
                    await self._web_socket.send_bytes(message)


@dataclass(frozen=True, slots=True, kw_only=True)
class SocketOptions:
    """Options of a server's WebSockets."""

    serve: Callable[[SocketClient], Awaitable[None]]
    """Serves one client until it disconnects."""
    max_clients: int = 100
    ping_s: float | None = None
    compresses: bool = False


class WebServer:
    """Web server of a node."""

    def __init__(
        self,
        access: Access,
        pages: Mapping[str, Handler],
        *,
        sockets: SocketOptions | None = None,
        max_streams: int = 100,
    ) -> None:
        """Serve pages by path, and WebSockets at any path.

        Args:
            access: decides which requests are served.
            pages: path → handler.
            sockets: WebSocket options; None: no WebSockets.
            max_streams: maximum of simultaneous streams.
        """
        self._access = access
        self._pages = pages
        self._sockets = sockets
        self._clients = 0
        self._streams = 0
        self._max_streams = max_streams
        self._guard = Guard(access)
        self._runner: web.AppRunner | None = None

    async def start(self, listening: socket.socket, certificate: ssl.SSLContext | None = None) -> None:
        """Serve connections of a listening socket."""
        logging.getLogger("aiohttp").setLevel(logging.CRITICAL)  # aiohttp logs tracebacks for malformed requests
        app = web.Application()
        app.router.add_get("/{path:.*}", self._answer)
        self._runner = web.AppRunner(
            app, access_log=None, handle_signals=False, handler_cancellation=True, shutdown_timeout=_SHUTDOWN_S
        )
        await self._runner.setup()
        await web.SockSite(self._runner, listening, ssl_context=certificate).start()

    async def close(self) -> None:
        """Close all connections."""
        if self._runner is not None:
            await self._runner.cleanup()

    async def _answer(self, request: web.Request) -> web.StreamResponse:
        if (refused := await self._guard.refuse(request)) is not None:
            return refused
        if request.headers.get("Upgrade", "").lower() == "websocket":
            return await self._serve_socket(request)
        page = self._pages.get(request.path)
        if page is None:
            return _text(404, "no such page\n")
        reply = await page(dict(request.query))
        fields = self._fields(self._guard.read(request))
        if reply.parts is None:
            headers = {"Content-Type": reply.content_type, **fields, **reply.fields}
            return web.Response(status=reply.status, body=reply.body, headers=headers)
        return await self._stream(request, reply, reply.parts, fields)

    def _fields(self, page_request: PageRequest) -> dict[str, str]:
        """Return headers that let pages of this machine show the response, and allowed origins read it."""
        access = self._access
        fields = dict(_NO_SNIFFING)
        if "Set-Cookie" in (headers := access.response_fields(page_request)):
            fields["Set-Cookie"] = headers["Set-Cookie"]
        is_shared = access.is_open or access.allowed.origins or access.serves_null_origin
        fields["Cross-Origin-Resource-Policy"] = "cross-origin" if is_shared else "same-site"
        if access.is_open:
            fields["Access-Control-Allow-Origin"] = "*"
        elif page_request.origin is not None:
            fields |= {"Access-Control-Allow-Origin": page_request.origin, "Vary": "Origin"}
        return fields

    async def _stream(
        self, request: web.Request, reply: Reply, parts: AsyncGenerator[bytes, None], fields: Mapping[str, str]
    ) -> web.StreamResponse:
        if self._streams >= self._max_streams:
            return _text(503, f"{self._max_streams} streams are served already\n")
        response = web.StreamResponse(headers={"Content-Type": reply.content_type, **fields, **reply.fields})
        response.force_close()
        self._streams += 1
        try:
            await response.prepare(request)
            async for part in parts:
                await response.write(part)
        except ConnectionError:
            pass  # the client has disconnected
        finally:
            self._streams -= 1
            await parts.aclose()
        return response

    async def _serve_socket(self, request: web.Request) -> web.StreamResponse:
        options = self._sockets
        if options is None:
            return _text(400, "no WebSockets here\n")
        if self._clients >= options.max_clients:
            return _text(503, f"{options.max_clients} clients are served already\n")
        web_socket = web.WebSocketResponse(
            heartbeat=options.ping_s, compress=options.compresses, max_msg_size=_MAX_MESSAGE_BYTES
        )
        try:
            await web_socket.prepare(request)
        except web.HTTPException as error:
            return _text(error.status, f"{error.text or error.reason}\n")
        self._clients += 1
        client = SocketClient(web_socket, request.remote or "")
        sending = asyncio.create_task(client.send_all())
        try:
            await options.serve(client)
        finally:
            self._clients -= 1
            sending.cancel()
            await asyncio.wait((sending,))
            with contextlib.suppress(ConnectionError, TimeoutError):
                async with asyncio.timeout(_SHUTDOWN_S):
                    await web_socket.close()
        return web_socket


def _text(status: int, text: str) -> web.Response:
    return web.Response(status=status, text=text, headers=_NO_SNIFFING)
