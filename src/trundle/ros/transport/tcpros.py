"""TCPROS connection on the loop: connection headers first, then frames."""

import asyncio
import contextlib
import socket
from collections.abc import Callable, Iterable, Mapping
from typing import Protocol, cast

from ..errors import WireError
from .framing import FrameDecoder
from .headers import MAX_HEADER_BYTES, MAX_MESSAGE_BYTES, decode_header, encode_header
from .send_queue import SendQueue
from .unix_sockets import UNIXROS

HANDSHAKE_S = 15.0
"""Timeout for the peer's header."""


class SocketSelector(Protocol):
    """Selector that calls the readers of sockets, in its thread."""

    def add_reader(self, sock: socket.socket, readable: Callable[[], object], /) -> None:
        """Call `readable` whenever the socket is readable or closed, until `remove_reader`."""

    def remove_reader(self, sock: socket.socket, /) -> None:
        """Stop calling the socket's reader, which does not run any more."""


class FrameProtocol(asyncio.BufferedProtocol):
    """Connection that splits the received stream into frames, of which the first is the header.

    Runs on the loop, except that any thread may send.
    """

    out: SendQueue
    """Send queue, usable from any thread; set once connected."""

    def __init__(self) -> None:
        self.transport: asyncio.Transport | None = None
        self.header: dict[str, str] | None = None
        self.bytes_received = 0
        self.frames = FrameDecoder(MAX_HEADER_BYTES)
        self._deadline: asyncio.TimerHandle | None = None
        self._selector: SocketSelector | None = None
        self._socket: socket.socket | None = None
        """Duplicate of the socket, read directly instead of through asyncio."""
        self._close_reason: str | None = None

    # for subclasses to override

    def connected(self) -> None:
        """Called once connected; a client sends its header here."""

    def header_received(self, header: dict[str, str]) -> None:
        """Called with the peer's header; a WireError ends the connection."""

    def frame_received(self, data: bytes | memoryview) -> None:
        """Called with each frame after the header; a WireError ends the connection."""

    def note_received(self, note: bytes, /) -> bytes | None:
        """Called with each note of a local peer; returns the frame it announces, if any. May raise WireError."""
        raise WireError(f"an unexpected note of {len(note)} bytes")

    def drained(self) -> None:
        """Called when a congested queue is empty again."""

    def closed(self, reason: str, /) -> None:
        """Called once when the connection has ended."""

    # asyncio's side

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        self.transport = cast(asyncio.Transport, transport)
        self.out = SendQueue(transport.get_extra_info("socket"), drained=self._on_drained, broken=self._abort)
        if self.out.is_local:
            self.frames.on_note = self.note_received
        self._deadline = asyncio.get_running_loop().call_later(HANDSHAKE_S, self._on_timeout)
        self.connected()

    def get_buffer(self, sizehint: int) -> memoryview:
        del sizehint
        return self.frames.get_buffer()

    def buffer_updated(self, nbytes: int) -> None:
        self._received(nbytes, self.frames.decode(nbytes))

    def _received(self, count: int, contents: Iterable[bytes | memoryview]) -> None:
        """Process bytes received, and the frames among them."""
        self.bytes_received += count
        try:
            for content in contents:
                if self.header is None:
                    self._read_header(content)
                else:
                    self.frame_received(content)
                if self.transport is None:
                    break
        except WireError as error:
            self.close(str(error))

    def _read_header(self, content: bytes | memoryview) -> None:
        self.header = decode_header(bytes(content))
        self.frames.limit = MAX_MESSAGE_BYTES
        if self._deadline is not None:
            self._deadline.cancel()
        self.header_received(self.header)

    def connection_lost(self, exc: Exception | None) -> None:
        self._end(str(exc) if exc is not None else "the peer closed the connection")

    # bypassing asyncio

    def read_through(self, selector: SocketSelector) -> None:
        """Read through a selector from now on, in its thread and faster than by asyncio's transport."""
        if selector is self._selector or self.transport is None:
            return
        with contextlib.suppress(OSError):  # out of file descriptors: asyncio goes on reading
            sock: socket.socket = self._socket or self.transport.get_extra_info("socket").dup()
            self._stop_reading()
            self.transport.pause_reading()
            self._selector, self._socket = selector, sock
            selector.add_reader(sock, self._readable)

    def _stop_reading(self) -> None:
        """Leave the selector; in its thread or on the loop."""
        selector, self._selector = self._selector, None
        if selector is not None and self._socket is not None:
            selector.remove_reader(self._socket)

    def _readable(self) -> None:
        assert self._socket is not None
        try:
            count = self._socket.recv_into(self.frames.get_buffer())
        except OSError as error:
            self._cannot_read(error)
            return
        if count:
            self.buffer_updated(count)
        else:
            self.close("the peer closed the connection")

    def _cannot_read(self, error: OSError) -> None:
        if not isinstance(error, BlockingIOError):
            self.close(str(error))

    # for users

    def send_header(self, fields: Mapping[str, str]) -> None:
        """Send the connection header."""
        self.out.send([(encode_header(fields),)], None)

    def refuse(self, reason: str) -> None:
        """Answer a header with an error and end the connection."""
        self.send_header({"error": reason})
        self.close(reason)

    def finish(self, reason: str) -> None:
        """Close once everything queued is sent."""
        self._close_reason = reason
        if not self.out.is_congested:
            self.close(reason)

    def close(self, reason: str = "closed") -> None:
        """End the connection."""
        if self.transport is not None:
            transport = self.transport
            self._end(reason)
            transport.close()

    def set_nodelay(self) -> None:
        """Set TCP_NODELAY: small messages are sent at once."""
        if self.transport is not None and not self.out.is_local:
            self.transport.get_extra_info("socket").setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)

    @property
    def kind(self) -> str:
        """Transport name, as in the slave API."""
        return UNIXROS if self.out.is_local else "TCPROS"

    @property
    def description(self) -> str:
        """Connection description for `rosnode info`; empty without ports."""
        if self.transport is None or self.out.is_local:
            return ""
        local, peer = self.transport.get_extra_info("sockname"), self.transport.get_extra_info("peername")
        number = self.transport.get_extra_info("socket").fileno()
        return f"TCPROS connection on port {local[1]} to [{peer[0]}:{peer[1]} on socket {number}]"

    def _on_drained(self) -> None:
        if self._close_reason is None:
            self.drained()
        else:
            self.close(self._close_reason)

    def _abort(self) -> None:
        if self.transport is not None:
            self.transport.abort()

    def _on_timeout(self) -> None:
        self.close("no connection header came in time")

    def _end(self, reason: str) -> None:
        if self.transport is None:
            return
        self._stop_reading()
        self.transport = None
        self.out.close()
        if self._socket is not None:
            self._socket.close()
        if self._deadline is not None:
            self._deadline.cancel()
        self.closed(reason)
