"""XML-RPC server on asyncio: HTTP/1.0 and 1.1 with keep-alive, bounded in size and time."""

import asyncio
import contextlib
import errno
import inspect
import logging
from collections.abc import Awaitable, Callable
from typing import Any

from trundle.base.shortage import shortage

from ..errors import PortTakenError, RosError, WireError
from ..transport.closing_loop import close_server
from .http import MAX_HEAD_BYTES, Head, answer, browser_refusal, parse_head
from .xmlrpc_text import decode_call, encode_fault, encode_response

_log = logging.getLogger(__name__)
_IDLE_S = 120.0
"""Idle timeout of kept-alive connections; clients reconnect by themselves."""
_REQUEST_S = 15.0
"""Timeout for receiving a request once its first byte arrived."""
_BACKLOG = 512
"""Length of the accept queue: a big launch starts a hundred nodes within a second."""

_MAX_CLIENTS = 512
"""Maximum number of open connections; beyond it, the one that was idle longest is closed, as after an idle timeout."""

_LARGE_BYTES = 1 << 20
"""Size from which a call is decoded in a thread: 64 MB of small values take seconds, and other calls must go on."""

Dispatch = Callable[[str, list[Any]], "Awaitable[object] | object"]
"""Executes one call; an exception becomes a fault."""


class UnknownMethodError(RosError):
    """The server has no method of this name."""


class RpcServer:
    """One XML-RPC interface on one port."""

    def __init__(self, dispatch: Dispatch) -> None:
        self._dispatch = dispatch
        self._server: asyncio.Server | None = None
        self._clients: dict[asyncio.StreamWriter, None] = {}
        """Ordered by last activity, longest idle first."""
        self._has_warned = False
        self.port = 0

    async def start(self, host: str, port: int) -> None:
        """Listen; port 0: any free port.

        Raises:
            PortTakenError: another program listens there.
        """
        try:
            self._server = await asyncio.start_server(
                self._serve, host, port, limit=MAX_HEAD_BYTES, backlog=_BACKLOG, reuse_address=True
            )
        except OSError as error:
            if error.errno == errno.EADDRINUSE:
                raise PortTakenError(host, port) from None
            reason = shortage(error) or error.strerror or error
            raise RosError(f"cannot listen on {host}:{port}: {reason}") from None
        self.port = self._server.sockets[0].getsockname()[1]

    @property
    def _is_serving(self) -> bool:
        return self._server is not None and self._server.is_serving()

    async def stop(self) -> None:
        """Stop listening and close all connections."""
        if self._server is not None:
            await close_server(self._server)
        for writer in list(self._clients):
            writer.close()

    async def _serve(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        self._clients[writer] = None
        if len(self._clients) > _MAX_CLIENTS:
            idle_client = next(iter(self._clients))
            del self._clients[idle_client]
            idle_client.transport.abort()
        try:
            while self._is_serving and await self._exchange(reader, writer):
                self._clients.pop(writer, None)
                self._clients[writer] = None
        except (OSError, asyncio.IncompleteReadError, asyncio.CancelledError, TimeoutError):
            pass  # closed by the peer, timed out, or stopped
        except (WireError, asyncio.LimitOverrunError) as error:
            with contextlib.suppress(OSError):
                writer.write(answer("400 Bad Request", str(error).encode(), keep_alive=False))
        finally:
            self._clients.pop(writer, None)
            writer.close()

    async def _exchange(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> bool:
        """Serve one request; True if the connection stays open."""
        async with asyncio.timeout(_IDLE_S):
            first = await reader.readexactly(1)
        async with asyncio.timeout(_REQUEST_S):
            head = parse_head(first + await reader.readuntil(b"\r\n\r\n"))
            if (reason := browser_refusal(head)) is not None:
                self._warn(reason)
                writer.write(
                    answer("403 Forbidden", f"refused: {reason}\n".encode(), keep_alive=False, kind="text/plain")
                )
                return False
            refusal = _refusal(head)
            if refusal is not None:
                writer.write(answer(refusal, b"", keep_alive=False))
                return False
            if head.fields.get("expect", "").lower() == "100-continue":
                writer.write(b"HTTP/1.1 100 Continue\r\n\r\n")
            body = await reader.readexactly(head.body_bytes or 0)
        writer.write(answer("200 OK", await self._answer(body), keep_alive=head.keeps_alive))
        async with asyncio.timeout(_REQUEST_S):
            await writer.drain()
        return head.keeps_alive

    def _warn(self, reason: str) -> None:
        """Log only the first refusal: a web page can send thousands of requests."""
        if not self._has_warned:
            self._has_warned = True
            _log.warning("port %d refused an HTTP request: %s", self.port, reason)

    async def _answer(self, body: bytes) -> bytes:
        try:
            is_large = len(body) >= _LARGE_BYTES
            method, arguments = await asyncio.to_thread(decode_call, body) if is_large else decode_call(body)
            result = self._dispatch(method, arguments)
            return encode_response(await result if inspect.isawaitable(result) else result)
        except WireError as error:
            return encode_fault(1, str(error))
        except UnknownMethodError as error:
            return encode_fault(1, f"<class 'Exception'>:{error}")
        except Exception as error:  # one bad call must not stop the server
            _log.debug("XML-RPC call failed", exc_info=True)
            return encode_fault(1, f"<class '{type(error).__name__}'>:{error}")


def _refusal(head: Head) -> str | None:
    if head.start[0] != "POST":
        return "501 Unsupported method"
    if "transfer-encoding" in head.fields or head.body_bytes is None:
        return "411 Length Required"
    return None
