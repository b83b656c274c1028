"""What goes to one peer: whoever sends writes as much as the kernel takes, from any thread; the rest waits."""

import asyncio
import contextlib
import os
import socket
import threading
from collections import deque
from collections.abc import Callable, Sequence
from itertools import islice

from ..errors import WireError
from ..messages.codec import Pieces
from .shared_ring import LONG_BYTES, SharedRing
from .unix_sockets import peer_process

_MAX_KERNEL_BYTES = 4 * 1024 * 1024
"""As much as TCP may take by Linux's own settings."""
_UNIX = getattr(socket, "AF_UNIX", None)
_WRITEV: "Callable[[int, Sequence[bytes | memoryview]], int] | None" = getattr(os, "writev", None)
"""Not on Windows, where a socket is no file."""
_AGAIN_S = 0.05
"""After which it is tried again where the loop cannot look."""
_AT_ONCE = 200
"""Frames given to the kernel in one call, which takes at most IOV_MAX (1024) pieces; a frame has three at most."""


class SendQueue:
    """A queue of frames and the socket they go into, which somebody else reads."""

    def __init__(self, sock: socket.socket, *, drained: Callable[[], None], broken: Callable[[], None]) -> None:
        """Begin; on the loop.

        Args:
            sock: connected and not blocking; stays its owner's.
            drained: called on the loop when the peer, having been too slow, has everything; it may send more.
            broken: called on the loop when nothing more can be sent.
        """
        self.is_local = sock.family == _UNIX
        """Whether the peer is reached without TCP."""
        self.is_congested = False
        """Whether something waits for a peer that reads too slowly."""
        self.bytes_sent = 0
        self.frames_sent = 0
        self.dropped = 0
        """Frames thrown away because the peer reads too slowly."""
        self._loop = asyncio.get_running_loop()
        self._drained = drained
        self._broken = broken
        self._socket = sock
        self._fd = sock.fileno()
        self._twin: socket.socket | None = None
        """The same connection once more: waits, as the loop keeps the first for its transport."""
        self._queue: deque[Pieces] = deque()
        self._rest: Pieces = ()
        """What was begun: of a frame that the kernel took a part of, and notes where others lie."""
        self._lock = threading.Lock()
        """Held while these change, and while the socket is written to or let go."""
        self._is_full = False
        """Whether the kernel takes no more for now."""
        self._is_waiting = False
        """Whether the loop looks when it does."""
        self._is_closed = False
        self._kernel_bytes = 0
        self._ring: SharedRing | None = None
        self._may_share = self.is_local
        """Whether it is worth a try to share memory with the peer."""

    def send(self, frames: Sequence[Pieces], queue_size: int | None) -> None:
        """Send, from any thread; never blocks. At most `queue_size` frames wait, and the oldest go."""
        if len(frames) == 1 and self.try_send(frames[0]):
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

    def try_send(self, frame: Pieces) -> bool:
        """Give the kernel one short frame past the queue, as nearly all go; any thread. False: it took nothing."""
        size = len(frame[0]) if len(frame) == 1 else _size(frame)
        if _WRITEV is None or (self.is_local and size >= LONG_BYTES):
            return False
        with self._lock:
            if self.is_congested or self._is_closed:
                return False
            try:
                sent = _WRITEV(self._fd, frame)
            except OSError:  # the queue meets it again
                return False
            self.bytes_sent += sent
            self.frames_sent += 1
            if sent < size:
                self._rest = _after(frame, sent)
                self.is_congested = self._is_full = True
                self._call_soon(self._wait)
        return True

    def receive_note(self, note: bytes) -> None:
        """Take what the peer says of the memory that both see, and go on if that makes room; on the loop.

        Raises:
            WireError: it cannot be meant.
        """
        with self._lock:
            if self._ring is None:
                raise WireError("a note about memory that is not shared")
            self._ring.receive_note(note)
            if self._is_full or not self.is_congested:
                return
        self._resume()

    def close(self) -> None:
        """Send nothing more; on the loop."""
        with self._lock:  # who writes now is done with the socket before it closes
            self._is_closed = True
            self._forget()
            self._stop_waiting()
            if self._twin is not None:
                self._twin.close()
            if self._ring is not None:
                self._ring.close()

    def _write(self) -> None:
        """Give the kernel, or the shelf, as much as it takes."""
        self._continue_write()
        self.is_congested = bool(self._rest or self._queue)

    def _continue_write(self) -> None:
        self._is_full = False
        while pieces := self._next():
            try:
                sent = self._send_pieces(pieces)
            except BlockingIOError:
                self._is_full = True
                return
            except OSError:  # the connection is broken
                self._forget()
                self._call_soon(self._broken)
                return
            self.bytes_sent += sent
            self._discard_sent(sent)

    def _next(self) -> list[bytes | memoryview]:
        """What the kernel gets next; nothing while a long frame waits for room on the shelf."""
        if self.is_local:
            self._share_frames()
        pieces = [*self._rest]
        for frame in islice(self._queue, _AT_ONCE):
            if self.is_local and (size := _size(frame)) >= LONG_BYTES:
                if not pieces and not (self._ring is not None and self._ring.has_room(size)):
                    self._grow_send_buffer(size)
                    pieces += frame
                break
            pieces += frame
        return pieces

    def _share_frames(self) -> None:
        """Put the long frames whose turn it is where the peer sees them."""
        while self._queue and (size := _size(self._queue[0])) >= LONG_BYTES:
            if self._ring is None:
                self._offer_ring(size)
            if self._ring is None or not self._ring.has_room(size):
                return
            if (note := self._ring.write(self._queue[0], size)) is None:
                return
            self._queue.popleft()
            self._rest = (*self._rest, note)
            self.frames_sent += 1
            self.bytes_sent += size

    def _offer_ring(self, size: int) -> None:
        if not self._may_share:
            return
        self._may_share = False
        with contextlib.suppress(OSError):
            if peer_process(self._socket) is not None:
                self._ring = SharedRing(size)
                self._rest = (*self._rest, self._ring.offer_note())

    def _send_pieces(self, pieces: list[bytes | memoryview]) -> int:
        return self._open_twin().send(pieces[0]) if _WRITEV is None else _WRITEV(self._fd, pieces)

    def _grow_send_buffer(self, size: int) -> None:
        """Have the kernel take a whole long frame at once; it does so by itself for TCP only."""
        if size <= self._kernel_bytes:
            return
        self._kernel_bytes = size
        with contextlib.suppress(OSError):
            wanted = min(2 * size, _MAX_KERNEL_BYTES)
            if wanted > self._socket.getsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF):
                self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, wanted)

    def _discard_sent(self, sent: int) -> None:
        """Take what was sent out of the queue."""
        while sent:
            if not self._rest:
                self._rest = self._queue.popleft()
                self.frames_sent += 1
            size = _size(self._rest)
            self._rest = () if sent >= size else _after(self._rest, sent)
            sent -= min(sent, size)

    def _forget(self) -> None:
        self._queue.clear()
        self._rest = ()
        self.is_congested = False

    def _open_twin(self) -> socket.socket:
        if self._twin is None:
            self._twin = self._socket.dup()
        return self._twin

    def _wait(self) -> None:
        with self._lock:
            if self._is_full and self.is_congested and not self._is_waiting:
                try:
                    self._loop.add_writer(self._open_twin().fileno(), self._resume)
                    self._is_waiting = True
                except OSError:  # no number is left for it
                    self._loop.call_later(_AGAIN_S, self._resume)

    def _resume(self) -> None:
        """Send more, now that there is room."""
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
            self._loop.remove_writer(self._open_twin().fileno())

    def _call_soon(self, function: Callable[[], None]) -> None:
        with contextlib.suppress(RuntimeError):  # the loop has ended
            self._loop.call_soon_threadsafe(function)


def _size(pieces: Pieces) -> int:
    return sum(map(len, pieces))


def _after(pieces: Pieces, count: int) -> Pieces:
    """Pieces without their first `count` bytes, of which there are more."""
    for i, piece in enumerate(pieces):
        if count < len(piece):
            return (memoryview(piece)[count:], *pieces[i + 1 :])
        count -= len(piece)
    return ()
