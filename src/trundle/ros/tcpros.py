"""TCPROS as bytes: connection headers and length-prefixed frames, both bounded."""

import asyncio
import socket
import struct
from collections import deque
from collections.abc import Mapping, Sequence
from typing import cast

from .errors import WireError

MAX_HEADER_BYTES = 4 * 1024 * 1024
"""A header holds a message definition; the longest in a desktop installation is below 100 kB."""
MAX_MESSAGE_BYTES = 1_000_000_000
"""roscpp drops a connection that announces more ("a message of over a gigabyte was predicted")."""
HANDSHAKE_S = 15.0
"""How long a peer may take for its header."""
_LENGTH = struct.Struct("<I")
LENGTH_BYTES = _LENGTH.size
_JOINED_BYTES = 64 * 1024
"""Frames are joined up to this size, since each call costs; larger ones cost more to copy."""


def encode_header(fields: Mapping[str, str]) -> bytes:
    """Write a connection header, with its length in front."""
    parts: list[bytes] = []
    for name, value in fields.items():
        item = f"{name}={value}".encode()
        parts += (_LENGTH.pack(len(item)), item)
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
        (size,) = _LENGTH.unpack_from(data, offset)
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
    return b"".join((_LENGTH.pack(len(data)), data))


def fill_frame(data: memoryview) -> memoryview:
    """Write the length into the room left for it in front; what comes out is read-only."""
    _LENGTH.pack_into(data, 0, len(data) - LENGTH_BYTES)
    return data.toreadonly()


def check_md5(wanted: str, ours: str) -> bool:
    """Tell whether two md5 sums agree; `*` agrees with all."""
    return wanted in ("*", ours)


class FrameProtocol(asyncio.Protocol):
    """A connection that splits what the peer sends into frames; the first one is its header.

    Memory grows with what has arrived, never with what is announced.
    """

    def __init__(self) -> None:
        self.transport: asyncio.Transport | None = None
        self.header: dict[str, str] | None = None
        self.bytes_received = 0
        self.bytes_sent = 0
        self.frames_sent = 0
        self.dropped = 0
        """Frames thrown away because the peer reads too slowly."""
        self._buffer = bytearray()
        self._deadline: asyncio.TimerHandle | None = None
        self._queue: deque[bytes | memoryview] = deque()
        self._may_write = True

    # what subclasses fill in

    def connected(self) -> None:
        """Called when the connection stands; a client sends its header here."""

    def header_received(self, header: dict[str, str]) -> None:
        """Called with the peer's header; a WireError ends the connection."""

    def frame_received(self, data: bytes) -> None:
        """Called with each frame after the header; a WireError ends the connection."""

    def drained(self) -> None:
        """Called when the peer, having been too slow, reads again."""

    def closed(self, reason: str, /) -> None:
        """Called once when the connection has ended."""

    # asyncio's side

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        self.transport = cast(asyncio.Transport, transport)
        self._deadline = asyncio.get_running_loop().call_later(HANDSHAKE_S, self._too_slow)
        self.connected()

    def data_received(self, data: bytes) -> None:
        self.bytes_received += len(data)
        self._buffer += data
        offset = 0
        try:
            while self.transport is not None and len(self._buffer) - offset >= 4:
                (size,) = _LENGTH.unpack_from(self._buffer, offset)
                if size > (MAX_HEADER_BYTES if self.header is None else MAX_MESSAGE_BYTES):
                    raise WireError(f"a frame of {size} bytes is announced, more than is accepted")
                if len(self._buffer) - offset - 4 < size:
                    break
                content = bytes(memoryview(self._buffer)[offset + 4 : offset + 4 + size])
                offset += 4 + size
                self._take(content)
            del self._buffer[:offset]
        except WireError as error:
            self.close(str(error))

    def _take(self, content: bytes) -> None:
        if self.header is not None:
            self.frame_received(content)
            return
        self.header = decode_header(content)
        if self._deadline is not None:
            self._deadline.cancel()
        self.header_received(self.header)

    def connection_lost(self, exc: Exception | None) -> None:
        self._end(str(exc) if exc is not None else "the peer closed the connection")

    def pause_writing(self) -> None:
        self._may_write = False

    def resume_writing(self) -> None:
        self._may_write = True
        # Not from here: asyncio 3.11 ends a connection twice when a write fails inside this call.
        asyncio.get_running_loop().call_soon(self._send_waiting)

    # for users

    def send_header(self, fields: Mapping[str, str]) -> None:
        """Send our header."""
        if self.transport is not None:
            self.transport.write(encode_header(fields))

    def send_all(self, frames: Sequence[bytes | memoryview], queue_size: int | None) -> None:
        """Send framed messages; if the peer reads too slowly, at most `queue_size` wait and the oldest go."""
        if not self.is_behind:
            if sum(map(len, frames)) <= _JOINED_BYTES:
                self._write(b"".join(frames), len(frames))
            else:
                for each in frames:
                    self._write(each, 1)
            return
        self._queue.extend(frames)
        while queue_size is not None and len(self._queue) > queue_size:
            self._queue.popleft()
            self.dropped += 1

    @property
    def is_behind(self) -> bool:
        """Whether something waits for a peer that reads too slowly."""
        return not self._may_write or bool(self._queue)

    def refuse(self, reason: str) -> None:
        """Answer a header with an error and end the connection."""
        self.send_header({"error": reason})
        self.close(reason)

    def close(self, reason: str = "closed") -> None:
        """End the connection; a peer that reads still gets what was written."""
        if self.transport is not None:
            transport = self.transport
            self._end(reason)
            if self._may_write:
                transport.close()
            else:
                transport.abort()

    def set_nodelay(self) -> None:
        """Send small messages at once."""
        if self.transport is not None:
            sock = self.transport.get_extra_info("socket")
            if sock is not None and sock.family in (socket.AF_INET, socket.AF_INET6):
                sock.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)

    @property
    def description(self) -> str:
        """The connection as rosnode reads it."""
        if self.transport is None:
            return ""
        local, peer = self.transport.get_extra_info("sockname"), self.transport.get_extra_info("peername")
        number = self.transport.get_extra_info("socket").fileno()
        return f"TCPROS connection on port {local[1]} to [{peer[0]}:{peer[1]} on socket {number}]"

    def _send_waiting(self) -> None:
        while self._queue and self._may_write:
            self._write(self._queue.popleft(), 1)
        if not self.is_behind:
            self.drained()

    def _write(self, data: bytes | memoryview, frames: int) -> None:
        if self.transport is not None and not self.transport.is_closing():
            self.bytes_sent += len(data)
            self.frames_sent += frames
            self.transport.write(data)

    def _too_slow(self) -> None:
        self.close("no connection header came in time")

    def _end(self, reason: str) -> None:
        if self.transport is None:
            return
        self.transport = None
        self._buffer.clear()
        self._queue.clear()
        if self._deadline is not None:
            self._deadline.cancel()
        self.closed(reason)
