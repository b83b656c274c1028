"""Send queue of one WebSocket, which drops the oldest messages of streams when the client is slow.

Frames are written to the socket from buffers that all clients share: asyncio's transport would copy them, which costs
more than sending them for point clouds of many megabytes.
"""

import asyncio
import contextlib
import socket
import struct
from collections import deque
from collections.abc import Callable, Hashable, Sequence
from itertools import islice
from typing import TypeAlias

Buffer: TypeAlias = bytes | memoryview

MAX_STREAM_BYTES = 4 * 1024 * 1024
"""Limit of queued bytes in streams; the newest message of each stream stays, however long."""
MAX_BYTES = 256 * 1024 * 1024
"""Limit of all queued bytes; a client that leaves more unread is disconnected."""
_OVERHEAD_BYTES = 512
"""Memory of a queued message in addition to its buffers."""
_MAX_BATCH = 256
"""Messages per call of sendmsg, which accepts at most IOV_MAX (1024) pieces."""
TEXT, BINARY, CLOSE, PONG = 0x81, 0x82, 0x88, 0x8A
"""First byte of an unfragmented frame: RFC 6455, 5.2."""


class _Message:
    """Queued message; without pieces once it is dropped."""

    __slots__ = ("pieces", "size", "stream")

    def __init__(self, stream: Hashable, pieces: Sequence[Buffer], size: int) -> None:
        self.stream = stream
        self.pieces = pieces
        self.size = size


class Outbox:
    """Queue of messages to one client; used on the loop only."""

    def __init__(
        self, sock: socket.socket, *, broken: Callable[[str], None], dropped: Callable[[Hashable], None]
    ) -> None:
        """Create it; call on the loop.

        Args:
            sock: connected, non-blocking socket; closed here.
            broken: called with the reason when the client disconnects or leaves too much unread.
            dropped: called with the stream of each dropped message.
        """
        self._socket = sock
        self._loop = asyncio.get_running_loop()
        self._broken = broken
        self._dropped = dropped
        self._queue: deque[_Message] = deque()
        self._rest: list[Buffer] = []
        """Unsent rest of the current batch."""
        self._streams: dict[Hashable, deque[_Message]] = {}
        """Queued messages that may be dropped, by stream."""
        self._stream_bytes: dict[Hashable, int] = {}
        self._waiting_bytes = self._droppable_bytes = 0
        self._is_watching = self._is_closed = self._is_due = False
        self._drained: asyncio.Event = asyncio.Event()

    @property
    def waiting_bytes(self) -> int:
        """Size of all queued messages [bytes]."""
        return self._waiting_bytes

    def send(self, first_byte: int, pieces: Sequence[Buffer], stream: Hashable = None) -> None:
        """Send or queue a message.

        Args:
            first_byte: frame's first byte.
            pieces: buffers of the payload, which must not change afterwards.
            stream: stream whose oldest messages are dropped if the client is slow; None: never dropped.
        """
        if self._is_closed:
            return
        size = sum(map(len, pieces))
        message = _Message(stream, (frame_header(first_byte, size), *pieces), size + _OVERHEAD_BYTES)
        self._queue.append(message)
        self._waiting_bytes += message.size
        if stream is not None:
            self._streams.setdefault(stream, deque()).append(message)
            self._stream_bytes[stream] = self._stream_bytes.get(stream, 0) + message.size
            self._droppable_bytes += message.size
        if self._droppable_bytes > MAX_STREAM_BYTES or self._waiting_bytes > MAX_BYTES:
            self._write_soon()
            self._drop_oldest()
        elif not self._is_due:
            self._is_due = True
            self._loop.call_soon(self._write_soon)
        if self._waiting_bytes > MAX_BYTES:
            self._fail(f"the client has left {self._waiting_bytes} bytes unread")

    def has_waiting(self, stream: Hashable) -> bool:
        """True if messages of a stream are queued."""
        return bool(self._streams.get(stream))

    async def drain(self, timeout_s: float) -> None:
        """Wait until everything is sent, or until the timeout."""
        if not self._queue and not self._rest:
            return
        self._drained.clear()
        with contextlib.suppress(TimeoutError):
            await asyncio.wait_for(self._drained.wait(), timeout_s)

    def close(self) -> None:
        """Close the socket and drop all messages."""
        if not self._is_closed:
            self._is_closed = True
            self._watch(False)
            self._socket.close()
            self._queue.clear()
            self._rest.clear()
            self._streams.clear()
            self._drained.set()

    def _drop_oldest(self) -> None:
        """Drop the oldest message of the stream with the most bytes, until the rest fits."""
        while self._droppable_bytes > MAX_STREAM_BYTES:
            droppable = [stream for stream, messages in self._streams.items() if len(messages) > 1]
            if not droppable:
                return
            self._drop(max(droppable, key=self._stream_bytes.__getitem__))

    def _drop(self, stream: Hashable) -> None:
        message = self._pop_first(stream)
        self._waiting_bytes -= message.size
        message.pieces = ()  # stays in the queue until its turn
        self._dropped(stream)

    def _pop_first(self, stream: Hashable) -> _Message:
        messages = self._streams[stream]
        message = messages.popleft()
        self._stream_bytes[stream] -= message.size
        self._droppable_bytes -= message.size
        if not messages:
            del self._streams[stream], self._stream_bytes[stream]
        return message

    def _write_soon(self) -> None:
        """Write the messages of this round of the loop, unless the socket's buffer is full."""
        self._is_due = False
        if not self._is_watching and not self._is_closed:
            self._write()

    def _write(self) -> None:
        """Write as much as the kernel accepts, and watch the socket for the rest."""
        try:
            while pieces := self._next():
                self._rest = _after(pieces, send_pieces(self._socket, pieces))
        except BlockingIOError:
            pass
        except OSError as error:
            self._fail(str(error))
            return
        self._watch(bool(self._rest))
        if not self._rest:
            self._drained.set()

    def _next(self) -> list[Buffer]:
        """Return the pieces to write next."""
        if not self._rest:
            for message in self._dequeue(_MAX_BATCH):
                self._rest += message.pieces
        return self._rest

    def _dequeue(self, count: int) -> list[_Message]:
        """Remove messages from the queue to be sent; they cannot be dropped afterwards."""
        batch: list[_Message] = []
        size = 0
        while self._queue and len(batch) < count and size < MAX_STREAM_BYTES:
            message = self._queue.popleft()
            if not message.pieces:
                continue
            if message.stream is not None:
                self._pop_first(message.stream)
            self._waiting_bytes -= message.size
            size += message.size
            batch.append(message)
        return batch

    def _watch(self, on: bool) -> None:
        """Start or stop writing whenever the socket has room."""
        if on != self._is_watching:
            self._is_watching = on
            if on:
                self._loop.add_writer(self._socket.fileno(), self._write)
            else:
                self._loop.remove_writer(self._socket.fileno())

    def _fail(self, reason: str) -> None:
        if not self._is_closed:
            self.close()
            self._loop.call_soon(self._broken, reason)  # later: the caller may be iterating over all clients


def frame_header(first_byte: int, size: int) -> bytes:
    """Return the header of an unmasked frame: RFC 6455, 5.2."""
    if size < 126:
        return bytes((first_byte, size))
    if size < 65536:
        return struct.pack("!BBH", first_byte, 126, size)
    return struct.pack("!BBQ", first_byte, 127, size)


def send_pieces(sock: socket.socket, pieces: Sequence[Buffer]) -> int:
    """Send as many bytes of the buffers as the kernel accepts; return their number.

    Raises:
        BlockingIOError: the kernel accepts none.
    """
    if hasattr(sock, "sendmsg"):
        return sock.sendmsg(list(islice(pieces, 1024)))
    return sock.send(pieces[0])  # Windows


def _after(pieces: list[Buffer], count: int) -> list[Buffer]:
    """Return the buffers without their first `count` bytes."""
    for i, piece in enumerate(pieces):
        if count < len(piece):
            return [memoryview(piece)[count:], *pieces[i + 1 :]]
        count -= len(piece)
    return []
