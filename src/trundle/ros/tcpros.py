"""TCPROS as bytes: connection headers and length-prefixed frames, both bounded."""

import asyncio
import contextlib
import os
import socket
import threading
from collections import deque
from collections.abc import Mapping, Sequence
from itertools import islice
from typing import cast

from .errors import WireError
from .frames import LENGTH, FrameCutter
from .nearby import UNIXROS

MAX_HEADER_BYTES = 4 * 1024 * 1024
"""A header holds a message definition; the longest in a desktop installation is below 100 kB."""
MAX_MESSAGE_BYTES = 1_000_000_000
"""roscpp drops a connection that announces more ("a message of over a gigabyte was predicted")."""
HANDSHAKE_S = 15.0
"""How long a peer may take for its header."""
LENGTH_BYTES = LENGTH.size
_MOST_KERNEL_BYTES = 4 * 1024 * 1024
"""As much as TCP may take by Linux's own settings."""
_UNIX = getattr(socket, "AF_UNIX", None)
_AT_ONCE = 200
"""Frames given to the kernel in one call, which takes at most IOV_MAX (1024)."""


def encode_header(fields: Mapping[str, str]) -> bytes:
    """Write a connection header, with its length in front."""
    parts: list[bytes] = []
    for name, value in fields.items():
        item = f"{name}={value}".encode()
        parts += (LENGTH.pack(len(item)), item)
    return frame(b"".join(parts))


def decode_header(data: bytes) -> dict[str, str]:
    """Read a connection header, without the length in front.

    Raises:
        WireError: the bytes are no header.
    """
    fields: dict[str, str] = {}
    offset = 0
    while offset < len(data):
        if offset + 4 > len(data):
            raise WireError("a connection header ends within a length")
        (size,) = LENGTH.unpack_from(data, offset)
        item = data[offset + 4 : offset + 4 + size]
        if len(item) != size:
            raise WireError("a connection header is shorter than it says")
        name, equals, value = item.partition(b"=")
        if not equals:
            raise WireError("a connection header field has no '='")
        fields[name.decode("utf-8", "replace")] = value.decode("utf-8", "replace")
        offset += 4 + size
    return fields


def frame(data: bytes | bytearray | memoryview) -> bytes:
    """Put the length in front."""
    return b"".join((LENGTH.pack(len(data)), data))


def fill_frame(data: memoryview) -> memoryview:
    """Write the length into the room left for it in front; what comes out is read-only."""
    LENGTH.pack_into(data, 0, len(data) - LENGTH_BYTES)
    return data.toreadonly()


def check_md5(wanted: str, ours: str) -> bool:
    """Tell whether two md5 sums agree; `*` agrees with all."""
    return wanted in ("*", ours)


class FrameProtocol(asyncio.BufferedProtocol):
    """A connection that splits what the peer sends into frames; the first one is its header.

    Everything happens on the loop, but frames are sent from any thread.
    """

    def __init__(self) -> None:
        self.transport: asyncio.Transport | None = None
        self.header: dict[str, str] | None = None
        self.bytes_received = 0
        self.bytes_sent = 0
        self.frames_sent = 0
        """Our header is the first."""
        self.dropped = 0
        """Frames thrown away because the peer reads too slowly."""
        self._frames = FrameCutter(MAX_HEADER_BYTES)
        self._deadline: asyncio.TimerHandle | None = None
        self._queue: deque[bytes | memoryview] = deque()
        self._rest: memoryview | None = None
        """Of a frame that the kernel took a part of."""
        self._writing = threading.Lock()
        """Held while the two change, and while the socket is written to or let go."""
        self._socket = -1
        self._twin: socket.socket | None = None
        """Sends where the system has no writev, as Windows."""
        self._waiting: socket.socket | None = None
        """Looks whether the kernel takes more."""
        self._is_near = False
        self._kernel_bytes = 0
        self._ending: str | None = None

    # what subclasses fill in

    def connected(self) -> None:
        """Called when the connection stands; a client sends its header here."""

    def header_received(self, header: dict[str, str]) -> None:
        """Called with the peer's header; a WireError ends the connection."""

    def frame_received(self, data: bytes | memoryview) -> None:
        """Called with each frame after the header; a WireError ends the connection."""

    def drained(self) -> None:
        """Called when the peer, having been too slow, reads again."""

    def closed(self, reason: str, /) -> None:
        """Called once when the connection has ended."""

    # asyncio's side

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        self.transport = cast(asyncio.Transport, transport)
        self._loop = asyncio.get_running_loop()
        sock = transport.get_extra_info("socket")
        self._socket, self._is_near = sock.fileno(), sock.family == _UNIX
        if not hasattr(os, "writev"):
            self._twin = sock.dup()
        self._deadline = self._loop.call_later(HANDSHAKE_S, self._too_slow)
        self.connected()

    def get_buffer(self, sizehint: int) -> memoryview:
        del sizehint
        return self._frames.room()

    def buffer_updated(self, nbytes: int) -> None:
        self.bytes_received += nbytes
        try:
            for content in self._frames.cut(nbytes):
                self._take(content)
                if self.transport is None:
                    break
        except WireError as error:
            self.close(str(error))

    def _take(self, content: bytes | memoryview) -> None:
        if self.header is not None:
            self.frame_received(content)
            return
        self.header = decode_header(bytes(content))
        self._frames.limit = MAX_MESSAGE_BYTES
        if self._deadline is not None:
            self._deadline.cancel()
        self.header_received(self.header)

    def connection_lost(self, exc: Exception | None) -> None:
        self._end(str(exc) if exc is not None else "the peer closed the connection")

    # for users

    def send_header(self, fields: Mapping[str, str]) -> None:
        """Send our header."""
        self.send_all([encode_header(fields)], None)

    def send_all(self, frames: Sequence[bytes | memoryview], queue_size: int | None) -> None:
        """Send framed messages, from any thread; never blocks.

        If the peer reads too slowly, at most `queue_size` wait and the oldest go.
        """
        with self._writing:
            if self.transport is None:
                return
            was_behind = self.is_behind
            self._queue.extend(frames)
            if not was_behind:
                self._write()
            while queue_size is not None and len(self._queue) > queue_size:
                self._queue.popleft()
                self.dropped += 1
            if was_behind or not self.is_behind:
                return
        with contextlib.suppress(RuntimeError):  # the loop has ended
            self._loop.call_soon_threadsafe(self._wait_until_writable)

    @property
    def is_behind(self) -> bool:
        """Whether something waits for a peer that reads too slowly."""
        return self._rest is not None or bool(self._queue)

    def refuse(self, reason: str) -> None:
        """Answer a header with an error and end the connection."""
        self.send_header({"error": reason})
        self.close(reason)

    def finish(self, reason: str) -> None:
        """End the connection as soon as the peer has all that was sent."""
        self._ending = reason
        if not self.is_behind:
            self.close(reason)

    def close(self, reason: str = "closed") -> None:
        """End the connection."""
        if self.transport is not None:
            transport = self.transport
            self._end(reason)
            transport.close()

    def set_nodelay(self) -> None:
        """Send small messages at once."""
        if self.transport is not None and not self._is_near:
            self.transport.get_extra_info("socket").setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)

    @property
    def kind(self) -> str:
        """The protocol's name."""
        return UNIXROS if self._is_near else "TCPROS"

    @property
    def description(self) -> str:
        """The connection as rosnode reads it; one without ports needs no words."""
        if self.transport is None or self._is_near:
            return ""
        local, peer = self.transport.get_extra_info("sockname"), self.transport.get_extra_info("peername")
        number = self.transport.get_extra_info("socket").fileno()
        return f"TCPROS connection on port {local[1]} to [{peer[0]}:{peer[1]} on socket {number}]"

    def _write(self) -> None:
        """Give the kernel as much as it takes."""
        while self.is_behind:
            if self._is_near and self._queue and len(self._queue[0]) > self._kernel_bytes:
                self._widen(len(self._queue[0]))
            rest = () if self._rest is None else (self._rest,)
            try:
                sent = self._give([*rest, *islice(self._queue, _AT_ONCE)])
            except BlockingIOError:
                return
            except OSError:  # the connection is broken
                self._queue.clear()
                self._rest = None
                with contextlib.suppress(RuntimeError):  # the loop has ended
                    self._loop.call_soon_threadsafe(self._abort)
                return
            self.bytes_sent += sent
            self._let_go(sent)
            if self._rest is not None:
                return

    def _give(self, parts: list[bytes | memoryview]) -> int:
        return os.writev(self._socket, parts) if self._twin is None else self._twin.send(parts[0])

    def _widen(self, size: int) -> None:
        """Have the kernel take a whole long frame at once; it does so by itself for TCP only."""
        assert self.transport is not None
        self._kernel_bytes = size
        with contextlib.suppress(OSError):
            wanted = min(2 * size, _MOST_KERNEL_BYTES)
            sock = self.transport.get_extra_info("socket")
            if wanted > sock.getsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF):
                sock.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, wanted)

    def _let_go(self, sent: int) -> None:
        if self._rest is not None:
            if sent < len(self._rest):
                self._rest = self._rest[sent:]
                return
            sent -= len(self._rest)
            self._rest = None
        while sent:
            frame = self._queue.popleft()
            self.frames_sent += 1
            if sent < len(frame):
                self._rest = memoryview(frame)[sent:]
                return
            sent -= len(frame)

    def _wait_until_writable(self) -> None:
        if self.transport is not None and self.is_behind and self._waiting is None:
            # A loop keeps the socket itself for its transport.
            waiting: socket.socket = self.transport.get_extra_info("socket").dup()
            self._waiting = waiting
            self._loop.add_writer(waiting, self._writable)

    def _writable(self) -> None:
        with self._writing:
            self._write()
        if not self.is_behind:
            self._wait_no_more()
            if self._ending is None:
                self.drained()
            else:
                self.close(self._ending)

    def _wait_no_more(self) -> None:
        if self._waiting is not None:
            self._loop.remove_writer(self._waiting)
            self._waiting.close()
            self._waiting = None

    def _abort(self) -> None:
        if self.transport is not None:
            self.transport.abort()

    def _too_slow(self) -> None:
        self.close("no connection header came in time")

    def _end(self, reason: str) -> None:
        if self.transport is None:
            return
        with self._writing:  # who writes now is done with the socket before it closes
            self.transport = None
            self._queue.clear()
            self._rest = None
            if self._twin is not None:
                self._twin.close()
        self._wait_no_more()
        if self._deadline is not None:
            self._deadline.cancel()
        self.closed(reason)
