"""Shared memory between a publisher and one subscriber: holds long frames, while the socket carries their positions.

A socket's copy costs the kernel fresh pages for each image; the ring is reused. The publisher creates it for its first
long frame and announces it in a note; until the subscriber acknowledges, and always between different users, frames go
through the socket.
"""

import mmap
import os
import socket
import struct
from collections.abc import Callable
from typing import Any, Final

from .. import _message_codec
from ..errors import WireError
from .framing import LENGTH, Pieces, encode_note
from .unix_sockets import peer_process

LONG_BYTES: Final = 32 * 1024
"""Minimum frame length [bytes]; for shorter ones a socket is as fast."""
_FRAMES, _MIN_FRAMES = 16, 4
"""Capacity in frames of the first one's length, and the minimum for long frames."""
_MIN_BYTES, _USUAL_BYTES, _MAX_BYTES = 1024 * 1024, 32 * 1024 * 1024, 64 * 1024 * 1024
"""Limits of the ring's size; it exceeds the second one only to hold the minimum number of frames."""
_OPENED = struct.Struct("<QQ")
"""Publisher to subscriber: file descriptor in the publisher's process, size."""
_WRITTEN = struct.Struct("<QQQ")
"""Publisher to subscriber: start, length and end position of a frame."""
_READ = struct.Struct("<Q")
"""Subscriber to publisher: everything before this position may be overwritten; 0: the memory is mapped."""


class SharedRing:
    """Ring buffer of frames, each contiguous; the publisher's side.

    Positions count all bytes ever used, including those skipped at the ring's end.
    """

    def __init__(self, frame_bytes: int) -> None:
        """Allocate room for several frames of a length [bytes].

        Raises:
            OSError: no memfd on this system, or too little memory.
        """
        usual_size = min(max(_FRAMES * frame_bytes, _MIN_BYTES), _USUAL_BYTES)
        if (size := max(usual_size, _MIN_FRAMES * frame_bytes)) > _MAX_BYTES:
            raise OSError(f"frames of {frame_bytes} bytes are too long to be shared")
        self._size = -(-size // mmap.PAGESIZE) * mmap.PAGESIZE
        self._file = _sealed_memory(self._size)
        self._memory = mmap.mmap(self._file, self._size)
        self._end = 0
        self._acknowledged = 0
        self.is_mapped = False
        """True once the subscriber has mapped the memory."""

    def offer_note(self) -> bytes:
        """Note that announces the memory to the subscriber."""
        return encode_note(_OPENED.pack(self._file, self._size))

    def has_room(self, size: int) -> bool:
        """True if frames of this length go through the ring: with up to half of it unacknowledged, one always fits."""
        return self.is_mapped and LONG_BYTES <= size <= self._size // _MIN_FRAMES

    def write(self, frame: Pieces, size: int) -> bytes | None:
        """Copy a frame with its length prefix into the ring and return its note; None if there is no room yet."""
        offset = self._end % self._size
        skipped = self._size - offset if offset + size > self._size else 0
        end = self._end + skipped + size
        if end - self._acknowledged > self._size:
            return None
        offset = start = (self._end + skipped) % self._size
        for piece in frame:
            self._memory[offset : offset + len(piece)] = piece
            offset += len(piece)
        self._end = end
        return encode_note(_WRITTEN.pack(start, size, end))

    def receive_note(self, note: bytes | memoryview) -> None:
        """Process the subscriber's acknowledgement.

        Raises:
            WireError: the position is invalid.
        """
        (position,) = _unpacked(_READ, note)
        if not self._acknowledged <= position <= self._end:
            raise WireError("the peer acknowledged a position that was never written")
        self._acknowledged, self.is_mapped = position, True

    def close(self) -> None:
        """Unmap and close the memory."""
        self._memory.close()
        os.close(self._file)


class SharedRingReader:
    """The subscriber's side of a `SharedRing`."""

    def __init__(self, sock: socket.socket, note: bytes | memoryview) -> None:
        """Map the memory that the peer of a socket announces.

        Raises:
            WireError: the note is malformed.
            OSError: the memory cannot be opened.
        """
        number, self._size = _unpacked(_OPENED, note)
        if self._size > _MAX_BYTES:
            raise WireError(f"memory of {self._size} bytes is announced, more than the {_MAX_BYTES} accepted")
        if (process := peer_process(sock)) is None:
            raise PermissionError("the peer runs as another user")
        file = os.open(f"/proc/{process}/fd/{number}", os.O_RDONLY | os.O_NONBLOCK | os.O_NOCTTY)
        try:
            _check_seals(file, self._size)
            self._memory = mmap.mmap(file, self._size, access=mmap.ACCESS_READ)
            self._view = memoryview(self._memory)
        finally:
            os.close(file)
        self._acknowledged = 0
        _message_codec.keep_freed_memory(2 * self._size)  # for the copies of its frames

    def mapped_note(self) -> bytes:
        """Acknowledgement after which the publisher uses the ring."""
        return encode_note(_READ.pack(0))

    def read(self, note: bytes | memoryview, copy: Callable[[memoryview], Any] = bytes) -> tuple[Any, bytes | None]:
        """Copy a frame's content; the second value is the acknowledgement to send, if one is due.

        Args:
            note: publisher's note of the frame.
            copy: copies a view, which is overwritten later.

        Raises:
            WireError: the position is outside the ring.
        """
        start, size, end = _unpacked(_WRITTEN, note)
        if start + size > self._size:
            raise WireError("a frame is announced outside of the shared memory")
        with self._view[start + LENGTH.size : start + size] as view:
            content = copy(view)
        if end - self._acknowledged < self._size // 2:
            return content, None
        self._acknowledged = end
        return content, encode_note(_READ.pack(end))

    def close(self) -> None:
        """Unmap the memory."""
        self._view.release()
        self._memory.close()


def _sealed_memory(size: int) -> int:
    """Create an anonymous file sealed against shrinking, which would kill its readers with SIGBUS."""
    import fcntl  # lazy: missing on Windows

    file = os.memfd_create("trundle-shared-ring", os.MFD_CLOEXEC | os.MFD_ALLOW_SEALING)
    try:
        os.posix_fallocate(file, 0, size)  # allocate now: a failure on first write would be SIGBUS
        fcntl.fcntl(file, fcntl.F_ADD_SEALS, fcntl.F_SEAL_SHRINK | fcntl.F_SEAL_GROW | fcntl.F_SEAL_SEAL)
    except OSError:
        os.close(file)
        raise
    return file


def _check_seals(file: int, size: int) -> None:
    import fcntl

    if not fcntl.fcntl(file, fcntl.F_GET_SEALS) & fcntl.F_SEAL_SHRINK or os.fstat(file).st_size != size:
        raise WireError("the shared memory is not sealed, or its size is not the announced one")


def _unpacked(kind: struct.Struct, note: bytes | memoryview) -> tuple[Any, ...]:
    if len(note) != kind.size:
        raise WireError(f"a note has {len(note)} bytes, not {kind.size}")
    return kind.unpack(note)
