"""Send queue of one WebSocket: what the kernel does not take waits, and streams lose their oldest message first.

Frames go to the socket directly, from buffers that all clients share: asyncio's transport copies what it keeps, which
for clouds of many megabytes costs more than sending them.
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
"""Limit of what waits in streams; the newest message of each stays, however long."""
MAX_BYTES = 256 * 1024 * 1024
"""Limit of what waits in all; a client that leaves more unread is disconnected."""
_OVERHEAD_BYTES = 512
"""Memory of a waiting message beside its buffers."""
_AT_ONCE = 256
"""Messages per call of sendmsg, which takes at most IOV_MAX (1024) pieces."""
TEXT, BINARY, CLOSE, PONG = 0x81, 0x82, 0x88, 0x8A
"""First byte of a frame that is whole: RFC 6455, 5.2."""


class _Message:
    """Message that waits; without pieces once it is dropped."""

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
        """Create; call on the loop.

        Args:
            sock: connected and non-blocking; closed here.
            broken: called with the reason when the client is gone, or reads nothing for too long.
            dropped: called with the stream for each message that is dropped.
        """
        self._socket = sock
        self._loop = asyncio.get_running_loop()
        self._broken = broken
        self._dropped = dropped
        self._queue: deque[_Message] = deque()
        self._rest: list[Buffer] = []
        """Rest of messages that are partly sent."""
        self._streams: dict[Hashable, deque[_Message]] = {}
        """Waiting messages that may be dropped, by stream."""
        self._stream_bytes: dict[Hashable, int] = {}
        self._waiting_bytes = self._droppable_bytes = 0
        self._is_watching = self._is_closed = self._is_due = False
        self._drained: asyncio.Event = asyncio.Event()

    @property
    def waiting_bytes(self) -> int:
        """Size of what waits."""
        return self._waiting_bytes

    def send(self, first_byte: int, pieces: Sequence[Buffer], stream: Hashable = None) -> None:
        """Send a message, or queue it.

        Args:
            first_byte: of the frame.
            pieces: buffers of the payload, which must not change any more.
            stream: the oldest messages of a stream are dropped if the client is slow; None: never dropped.
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
        """True if messages of a stream wait."""
        return bool(self._streams.get(stream))

    async def drain(self, timeout_s: float) -> None:
        """Wait until everything is sent, or the timeout."""
        if not self._queue and not self._rest:
            return
        self._drained.clear()
        with contextlib.suppress(TimeoutError):
            await asyncio.wait_for(self._drained.wait(), timeout_s)

    def close(self) -> None:
        """Close the socket and drop what waits."""
        if not self._is_closed:
            self._is_closed = True
            self._watch(False)
            self._socket.close()
            self._queue.clear()
            self._rest.clear()
            self._streams.clear()
            self._drained.set()

    def _drop_oldest(self) -> None:
        """Have the stream with most bytes lose its oldest message, until the rest fits."""
        while self._droppable_bytes > MAX_STREAM_BYTES:
            longest = [stream for stream, waiting in self._streams.items() if len(waiting) > 1]
            if not longest:
                return
            self._drop(max(longest, key=self._stream_bytes.__getitem__))

    def _drop(self, stream: Hashable) -> None:
        message = self._forget_first(stream)
        self._waiting_bytes -= message.size
        message.pieces = ()  # stays in the queue until its turn
        self._dropped(stream)

    def _forget_first(self, stream: Hashable) -> _Message:
        waiting = self._streams[stream]
        message = waiting.popleft()
        self._stream_bytes[stream] -= message.size
        self._droppable_bytes -= message.size
        if not waiting:
            del self._streams[stream], self._stream_bytes[stream]
        return message

    def _write_soon(self) -> None:
        """Write what came in this round of the loop, at once, unless the kernel has no room."""
        self._is_due = False
        if not self._is_watching and not self._is_closed:
            self._write()

    def _write(self) -> None:
        """Write as much as the kernel takes, and watch for the rest."""
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
        """Pieces to write next."""
        if not self._rest:
            for message in self._dequeue(_AT_ONCE):
                self._rest += message.pieces
        return self._rest

    def _dequeue(self, count: int) -> list[_Message]:
        """Remove messages from the queue to be sent; from now on they cannot be dropped."""
        taken: list[_Message] = []
        size = 0
        while self._queue and len(taken) < count and size < MAX_STREAM_BYTES:
            message = self._queue.popleft()
            if not message.pieces:
                continue
            if message.stream is not None:
                self._forget_first(message.stream)
            self._waiting_bytes -= message.size
            size += message.size
            taken.append(message)
        return taken

    def _watch(self, wanted: bool) -> None:
        if wanted != self._is_watching:
            self._is_watching = wanted
            if wanted:
                self._loop.add_writer(self._socket.fileno(), self._write)
            else:
                self._loop.remove_writer(self._socket.fileno())

    def _fail(self, reason: str) -> None:
        if not self._is_closed:
            self.close()
            self._loop.call_soon(self._broken, reason)  # later: the caller may go through all clients


def frame_header(first_byte: int, size: int) -> bytes:
    """Header of a frame that is not masked: RFC 6455, 5.2."""
    if size < 126:
        return bytes((first_byte, size))
    if size < 65536:
        return struct.pack("!BBH", first_byte, 126, size)
    return struct.pack("!BBQ", first_byte, 127, size)


def send_pieces(sock: socket.socket, pieces: Sequence[Buffer]) -> int:
    """Send buffers, as many bytes as the kernel takes.

    Raises:
        BlockingIOError: it takes none.
    """
    if hasattr(sock, "sendmsg"):
        return sock.sendmsg(list(islice(pieces, 1024)))
    return sock.send(pieces[0])  # Windows


def _after(pieces: list[Buffer], count: int) -> list[Buffer]:
    """Buffers without their first `count` bytes."""
    for i, piece in enumerate(pieces):
        if count < len(piece):
            return [memoryview(piece)[count:], *pieces[i + 1 :]]
        count -= len(piece)
    return []
