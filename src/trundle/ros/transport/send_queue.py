"""Send queue of one connection: any thread writes as much as the kernel accepts, the loop writes the rest."""

import asyncio
import contextlib
import os
import socket
import threading
from collections import deque
from collections.abc import Callable, Sequence
from itertools import islice

from .. import _message_codec
from ..errors import WireError
from .framing import Pieces
from .shared_ring import LONG_BYTES, SharedRing
from .unix_sockets import peer_process

_MAX_KERNEL_BYTES = 4 * 1024 * 1024
"""Linux's default maximum for TCP."""
_UNIX = getattr(socket, "AF_UNIX", None)
_WRITEV: "Callable[[int, Sequence[bytes | memoryview]], int] | None" = getattr(os, "writev", None)
"""None on Windows, where sockets are not file descriptors."""
_RETRY_S = 0.05
"""Retry interval if the loop cannot watch the socket."""
_MAX_FRAMES = 200
"""Frames per writev call, which accepts at most IOV_MAX (1024) pieces; a frame has at most three."""


class SendQueue:
    """Queue of frames for one socket; reading from the socket is left to its owner."""

    def __init__(self, sock: socket.socket, *, drained: Callable[[], None], broken: Callable[[], None]) -> None:
        """Create; call on the loop.

        Args:
            sock: connected and non-blocking; not closed here.
            drained: called on the loop when a congested queue is empty again.
            broken: called on the loop when the connection is broken.
        """
        self.is_local = sock.family == _UNIX
        """True for Unix sockets."""
        self.is_congested = False
        """True while frames wait for a peer that reads too slowly."""
        self.direct = _message_codec.DirectSocket(sock.fileno())
        """Writes short frames while the queue is empty."""
        self.dropped = 0
        """Frames dropped because the peer reads too slowly."""
        self._loop = asyncio.get_running_loop()
        self._drained = drained
        self._broken = broken
        self._socket = sock
        self._fd = sock.fileno()
        self._bytes_sent = self._frames_sent = 0
        """Without those written directly."""
        self._duplicate: socket.socket | None = None
        """Duplicate of the socket to watch for writability, since the loop reserves the first for its transport."""
        self._queue: deque[Pieces] = deque()
        self._rest: Pieces = ()
        """Rest of a partly sent frame, and notes about shared frames."""
        self._lock = threading.Lock()
        """Guards the fields below and the socket's lifetime."""
        self._is_full = False
        """True while the kernel's buffer is full."""
        self._is_waiting = False
        """True while the loop watches for writability."""
        self._is_closed = False
        self._kernel_bytes = 0
        self._ring: SharedRing | None = None
        self._may_share = self.is_local
        """True until shared memory was offered."""
        self.direct.is_open = _WRITEV is not None

    @property
    def bytes_sent(self) -> int:
        """Bytes that were sent."""
        return self._bytes_sent + self.direct.bytes_sent

    @property
    def frames_sent(self) -> int:
        """Frames that were sent."""
        return self._frames_sent + self.direct.frames_sent

    def send(self, frames: Sequence[Pieces], queue_size: int | None) -> None:
        """Send frames; thread-safe, never blocks. At most `queue_size` frames wait; the oldest are dropped."""
        if len(frames) == 1 and self._write_directly(frames[0]):
            return
        with self._lock:
            if self._is_closed:
                return
            self._queue.extend(frames)
            if not self.is_congested:
                self._write()
            while queue_size is not None and len(self._queue) > queue_size:
                self._queue.popleft()
                self.dropped += 1
            if self._is_waiting or not self._is_full:
                return
        self._call_soon(self._wait)

    def _write_directly(self, frame: Pieces) -> bool:
        """Write one short frame, bypassing the queue (usual); thread-safe. False if nothing was written."""
        piece = frame[0] if len(frame) == 1 else None
        if not isinstance(piece, bytes) or len(piece) >= LONG_BYTES or not self.direct.write(piece):
            return False
        self.send_rest()
        return True

    def send_rest(self) -> None:
        """Queue the rest of a directly written frame that the kernel did not accept; thread-safe."""
        if not self.direct.is_open:
            self.send((), None)

    def receive_note(self, note: bytes) -> None:
        """Process the peer's note about the shared ring, and resume if it frees room; call on the loop.

        Raises:
            WireError: the note is invalid.
        """
        with self._lock:
            if self._ring is None:
                raise WireError("an acknowledgement of shared memory on a connection that has none")
            self._ring.receive_note(note)
            if self._is_full or not self.is_congested:
                return
        self._resume()

    def close(self) -> None:
        """Close; call on the loop."""
        with self._lock:  # wait for a thread that is writing
            self._is_closed = True
            self.direct.is_open = False
            self._clear()
            self._stop_waiting()
            if self._duplicate is not None:
                self._duplicate.close()
            if self._ring is not None:
                self._ring.close()

    def _write(self) -> None:
        """Write as much as the kernel and the shared ring accept."""
        self.direct.is_open = False
        if rest := self.direct.take_rest():
            self._rest = (rest, *self._rest)
        self._continue_write()
        self.is_congested = bool(self._rest or self._queue)
        self.direct.is_open = not (self.is_congested or self._is_closed) and _WRITEV is not None

    def _continue_write(self) -> None:
        self._is_full = False
        while pieces := self._next():
            try:
                sent = self._send_pieces(pieces)
            except BlockingIOError:
                self._is_full = True
                return
            except OSError:  # the connection is broken
                self._clear()
                self._call_soon(self._broken)
                return
            self._bytes_sent += sent
            self._discard_sent(sent)

    def _next(self) -> list[bytes | memoryview]:
        """Pieces to write next; empty while the first frame is to go through the ring, and the ring is full."""
        if self.is_local:
            self._share_frames()
        pieces = [*self._rest]
        for frame in islice(self._queue, _MAX_FRAMES):
            if self.is_local and (size := _size(frame)) >= LONG_BYTES:
                if not pieces and not (self._ring is not None and self._ring.has_room(size)):
                    self._grow_send_buffer(size)
                    pieces += frame
                break
            pieces += frame
        return pieces

    def _share_frames(self) -> None:
        """Move long frames at the head of the queue to the shared ring."""
        while self._queue and (size := _size(self._queue[0])) >= LONG_BYTES:
            if self._ring is None:
                self._offer_ring(size)
            if self._ring is None or not self._ring.has_room(size):
                return
            if (note := self._ring.write(self._queue[0], size)) is None:
                return
            self._queue.popleft()
            self._rest = (*self._rest, note)
            self._frames_sent += 1
            self._bytes_sent += size

    def _offer_ring(self, size: int) -> None:
        if not self._may_share:
            return
        self._may_share = False
        with contextlib.suppress(OSError):
            if peer_process(self._socket) is not None:
                self._ring = SharedRing(size)
                self._rest = (*self._rest, self._ring.offer_note())

    def _send_pieces(self, pieces: list[bytes | memoryview]) -> int:
        return self._open_duplicate().send(pieces[0]) if _WRITEV is None else _WRITEV(self._fd, pieces)

    def _grow_send_buffer(self, size: int) -> None:
        """Enlarge SO_SNDBUF to hold a whole long frame; the kernel adapts it for TCP only."""
        if size <= self._kernel_bytes:
            return
        self._kernel_bytes = size
        with contextlib.suppress(OSError):
            buffer_size = min(2 * size, _MAX_KERNEL_BYTES)
            if buffer_size > self._socket.getsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF):
                self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, buffer_size)

    def _discard_sent(self, sent: int) -> None:
        """Remove sent bytes from the queue."""
        while sent:
            if not self._rest:
                self._rest = self._queue.popleft()
                self._frames_sent += 1
            size = _size(self._rest)
            self._rest = () if sent >= size else _without_first(self._rest, sent)
            sent -= min(sent, size)

    def _clear(self) -> None:
        self._queue.clear()
        self._rest = ()
        self.is_congested = False

    def _open_duplicate(self) -> socket.socket:
        if self._duplicate is None:
            self._duplicate = self._socket.dup()
        return self._duplicate

    def _wait(self) -> None:
        with self._lock:
            if self._is_full and self.is_congested and not self._is_waiting:
                try:
                    self._loop.add_writer(self._open_duplicate().fileno(), self._resume)
                    self._is_waiting = True
                except OSError:  # out of file descriptors
                    self._loop.call_later(_RETRY_S, self._resume)

    def _resume(self) -> None:
        """Continue writing."""
        with self._lock:
            self._write()
        if not self.is_congested:
            self._drained()
        self._wait()
        with self._lock:
            if not self._is_full:
                self._stop_waiting()

    def _stop_waiting(self) -> None:
        if self._is_waiting:
            self._is_waiting = False
            self._loop.remove_writer(self._open_duplicate().fileno())

    def _call_soon(self, function: Callable[[], None]) -> None:
        with contextlib.suppress(RuntimeError):  # the loop has ended
            self._loop.call_soon_threadsafe(function)


def _size(pieces: Pieces) -> int:
    return sum(map(len, pieces))


def _without_first(pieces: Pieces, count: int) -> Pieces:
    """Pieces without their first `count` bytes, which must be fewer than all."""
    for i, piece in enumerate(pieces):
        if count < len(piece):
            return (memoryview(piece)[count:], *pieces[i + 1 :])
        count -= len(piece)
    return ()
