"""Frames out of a stream of bytes: each is its length, then so many bytes."""

import struct
import threading
from collections.abc import Callable, Iterator
from functools import cache
from typing import Any

from ..errors import WireError

LENGTH = struct.Struct("<I")
_SHARED_BYTES = 16 * 1024
"""Holds hundreds of small messages; more at a time would keep other connections of a busy graph waiting."""
_LONG_BYTES = 4 * 1024
"""A frame from here on comes to lie where it stays."""
_TRUST_BYTES = 256 * 1024
"""How much room a frame gets before any of it has come, unless one as long came before."""
_NOTE = 1 << 31
"""Added to the length of what is no message but a word between two of our own programs."""
_MAX_NOTE_BYTES = 64
_of_this_thread = threading.local()


def encode_note(content: bytes) -> bytes:
    """Write a note, which only a `FrameDecoder` that takes notes will read."""
    return LENGTH.pack(_NOTE | len(content)) + content


class FrameDecoder:
    """Says where the next bytes of a stream go, and cuts frames out of what was put there.

    Short frames are copied out of a buffer shared by all connections of a thread. Memory grows with what has
    arrived, never with what is announced.
    """

    def __init__(self, limit: int) -> None:
        self.limit = limit
        """Longest frame that is accepted [bytes]; it may change between two frames."""
        self.on_note: Callable[[bytes], bytes | None] | None = None
        """Called with each note, if there may be any; returns the content of a frame that it stands for."""
        self._shared = _shared_buffer()
        self._rest = b""
        """Beginning of a short frame."""
        self._own: memoryview | None = None
        """Where a long frame comes to lie, its length in front."""
        self._filled = 0
        self._expected = 0
        """Size of the last frame with its length, if that was a long one: the next one may be as long."""

    def get_buffer(self) -> memoryview:
        """Return where to put what comes next; valid until the next call for any connection of this thread."""
        if self._own is None and self._expected:
            self._own = _copied(self._rest, self._expected)
            self._filled, self._rest = len(self._rest), b""
        if self._own is not None:
            return self._own[self._filled :]
        self._shared[: len(self._rest)] = self._rest
        return self._shared[len(self._rest) :]

    def get_frame_buffer(self) -> memoryview | None:
        """Return where a frame may come to lie that comes alone; None within one, or after a long one."""
        return None if self._rest or self._own is not None or self._expected else self._shared

    def decode(self, count: int) -> Iterator[bytes | memoryview]:
        """Take note of so many new bytes; yield the frames that are complete, without their lengths.

        Raises:
            WireError: a frame longer than the limit is announced.
        """
        data, end = (self._shared, len(self._rest) + count) if self._own is None else (self._own, self._filled + count)
        start = size = 0
        while (begin := start + LENGTH.size) <= end:
            (size,) = LENGTH.unpack_from(data, start)
            if size > self.limit:
                if self.on_note is None or not _NOTE <= size <= _NOTE + _MAX_NOTE_BYTES:
                    raise WireError(f"a frame of {size} bytes is announced, more than is accepted")
                size -= _NOTE
                if begin + size > end:
                    break
                start = begin + size
                self._expected = 0
                if (content := self.on_note(bytes(data[begin:start]))) is not None:
                    yield content
                size = 0
                continue
            if begin + size > end:
                break
            start = begin + size
            self._expected = size + LENGTH.size if size > _LONG_BYTES else 0
            fills = data is self._own and start == len(data)
            yield data[begin:start].toreadonly() if fills and self._expected else bytes(data[begin:start])
            size = 0
        rest, size = data[start:end], size + LENGTH.size
        if size <= _LONG_BYTES:
            self._own, self._rest = None, bytes(rest)
            return
        if data is not self._own or start or end == len(data):
            self._own = _copied(rest, min(size, max(2 * len(rest), self._expected, _TRUST_BYTES)))
        self._rest, self._filled = b"", len(rest)


def _uninitialized(size: int) -> memoryview:
    """Memory as it comes: to clear a picture's takes as long as to write it."""
    return _numpy().empty(size, "u1").data


@cache
def _numpy() -> Any:
    import numpy  # not where only short messages are heard

    return numpy


def _copied(data: bytes | memoryview, size: int) -> memoryview:
    """Copy to the beginning of new memory, whose rest is not touched."""
    moved = _uninitialized(size)
    moved[: len(data)] = data
    return moved


def _shared_buffer() -> memoryview:
    if not hasattr(_of_this_thread, "buffer"):
        _of_this_thread.buffer = memoryview(bytearray(_SHARED_BYTES))
    return _of_this_thread.buffer
