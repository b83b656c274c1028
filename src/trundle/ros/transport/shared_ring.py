"""Memory that a publisher and one subscriber share: long frames lie there, and the socket carries only where.

A socket's copy costs the kernel fresh pages for each picture; this memory is the same all the time. The publisher
makes it when its first long frame is due and says so in a note; until the subscriber has answered with one,
frames go as before. Both run as one user, or the socket carries all.
"""

import mmap
import os
import socket
import struct
from typing import Any, Final

from ..errors import WireError
from ..messages.codec import Pieces
from .framing import LENGTH, encode_note
from .unix_sockets import peer_process

LONG_BYTES: Final = 32 * 1024
"""Frames from here on; for shorter ones a socket is as fast."""
_FRAMES, _FEWEST_FRAMES = 8, 4
"""As many as the first one are to find room; of long ones fewer."""
_MIN_BYTES, _PLENTY_BYTES, _MAX_BYTES = 1024 * 1024, 32 * 1024 * 1024, 64 * 1024 * 1024
"""The second one is passed for the sake of the fewest frames only."""
_OPENED = struct.Struct("<QQ")
"""Publisher to subscriber: the file's number in the publisher's process, and its size."""
_WRITTEN = struct.Struct("<QQQ")
"""Publisher to subscriber: a frame's first byte, its length, and the position behind it."""
_READ = struct.Struct("<Q")
"""Subscriber to publisher: everything before this position may be written over; 0: the memory is seen."""


class SharedRing:
    """A ring of bytes that frames are laid into, each in one piece.

    Positions count all bytes ever used, those skipped at the ring's end as well.
    """

    def __init__(self, longest: int) -> None:
        """Make room for several frames of this length.

        Raises:
            OSError: no such memory here, or not as much as that takes.
        """
        plenty = min(max(_FRAMES * longest, _MIN_BYTES), _PLENTY_BYTES)
        if (wanted := max(plenty, _FEWEST_FRAMES * longest)) > _MAX_BYTES:
            raise OSError(f"frames of {longest} bytes are too long to be shared")
        self._size = -(-wanted // mmap.PAGESIZE) * mmap.PAGESIZE
        self._file = _sealed_memory(self._size)
        self._memory = mmap.mmap(self._file, self._size)
        self._end = 0
        self._taken = 0
        self.is_seen = False
        """Whether the subscriber has it, too."""

    def offer_note(self) -> bytes:
        """Return the note that tells the subscriber where it is."""
        return encode_note(_OPENED.pack(self._file, self._size))

    def has_room(self, size: int) -> bool:
        """Whether frames of this length are laid here: with a half not yet told to be free, one always fits."""
        return self.is_seen and LONG_BYTES <= size <= self._size // _FEWEST_FRAMES

    def write(self, frame: Pieces, size: int) -> bytes | None:
        """Copy a frame, its length in front, and return the note to send; None: there is no room yet."""
        at = self._end % self._size
        skipped = self._size - at if at + size > self._size else 0
        end = self._end + skipped + size
        if end - self._taken > self._size:
            return None
        at = start = (self._end + skipped) % self._size
        for piece in frame:
            behind = at + len(piece)
            self._memory[at:behind] = piece
            at = behind
        self._end = end
        return encode_note(_WRITTEN.pack(start, size, end))

    def receive_note(self, note: bytes | memoryview) -> None:
        """Learn what the subscriber is done with.

        Raises:
            WireError: it cannot be.
        """
        (position,) = _unpacked(_READ, note)
        if not self._taken <= position <= self._end:
            raise WireError("the peer took what was never laid there")
        self._taken, self.is_seen = position, True

    def close(self) -> None:
        """Let go of the memory."""
        self._memory.close()
        os.close(self._file)


class SharedRingReader:
    """The subscriber's side of a `SharedRing`."""

    def __init__(self, sock: socket.socket, note: bytes | memoryview) -> None:
        """Find it, as the peer of a socket says where.

        Raises:
            WireError: the note is none.
            OSError: it cannot be seen from here.
        """
        number, self._size = _unpacked(_OPENED, note)
        if self._size > _MAX_BYTES:
            raise WireError(f"memory of {self._size} bytes is announced, more than is accepted")
        if (process := peer_process(sock)) is None:
            raise PermissionError("the peer is no program of this user")
        file = os.open(f"/proc/{process}/fd/{number}", os.O_RDONLY | os.O_NONBLOCK | os.O_NOCTTY)
        try:
            _check_seals(file, self._size)
            self._memory = mmap.mmap(file, self._size, access=mmap.ACCESS_READ)
        finally:
            os.close(file)
        self._told = 0

    def seen_note(self) -> bytes:
        """Return the note with which the publisher begins to use it."""
        return encode_note(_READ.pack(0))

    def read(self, note: bytes | memoryview) -> tuple[bytes, bytes | None]:
        """Return a copy of a frame's content, and the note to answer with now and then.

        Raises:
            WireError: there can be no frame.
        """
        start, size, end = _unpacked(_WRITTEN, note)
        if start + size > self._size:
            raise WireError("a frame is announced outside of the shared memory")
        content = self._memory[start + LENGTH.size : start + size]
        if end - self._told < self._size // 2:
            return content, None
        self._told = end
        return content, encode_note(_READ.pack(end))

    def close(self) -> None:
        """Let go of the memory."""
        self._memory.close()


def _sealed_memory(size: int) -> int:
    """Make a file without a name that nobody can shorten: who reads it would be killed."""
    import fcntl  # not where there are no such files

    file = os.memfd_create("trundle-shelf", os.MFD_CLOEXEC | os.MFD_ALLOW_SEALING)
    try:
        os.posix_fallocate(file, 0, size)  # here and now, or whoever writes there later is killed
        fcntl.fcntl(file, fcntl.F_ADD_SEALS, fcntl.F_SEAL_SHRINK | fcntl.F_SEAL_GROW | fcntl.F_SEAL_SEAL)
    except OSError:
        os.close(file)
        raise
    return file


def _check_seals(file: int, size: int) -> None:
    import fcntl

    if not fcntl.fcntl(file, fcntl.F_GET_SEALS) & fcntl.F_SEAL_SHRINK or os.fstat(file).st_size != size:
        raise WireError("the shared memory is not what it was said to be")


def _unpacked(kind: struct.Struct, note: bytes | memoryview) -> tuple[Any, ...]:
    if len(note) != kind.size:
        raise WireError(f"a note of {len(note)} bytes where one of {kind.size} belongs")
    return kind.unpack(note)
