"""Length-prefixed frames of a byte stream."""

import struct
import threading
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import cache
from typing import Any, TypeAlias

from ..errors import WireError

LENGTH = struct.Struct("<I")
Pieces: TypeAlias = tuple[bytes | memoryview, ...]
"""Buffers of one frame, in order."""
Split: TypeAlias = (
    "Callable[[Callable[[memoryview], int], memoryview, memoryview, int, int], tuple[Sequence[Any], int, int]]"
)
"""`receive` of `_message_codec` or of a type's codec: receives into part of a buffer and splits it all into frames."""
_SHARED_BYTES = 16 * 1024
"""Room for hundreds of small messages; a larger buffer would delay other connections of a busy graph."""
_LONG_BYTES = 4 * 1024
"""Frames of this length and more are received in place, without a copy."""
_TRUST_BYTES = 256 * 1024
"""Buffer allocated for a frame before any of it arrived, unless the last frame was as long."""
_NOTE = 1 << 31
"""Flag in the length of a control note between two Trundle programs."""
_MAX_NOTE_BYTES = 64
_thread_local = threading.local()


def encode_note(content: bytes) -> bytes:
    """Encode a note; only a `FrameDecoder` with `on_note` accepts it."""
    return LENGTH.pack(_NOTE | len(content)) + content


class FrameDecoder:
    """Provides the receive buffer of a stream and splits received bytes into frames.

    Short frames are copied out of a buffer shared by all connections of a thread. Memory grows with the bytes received,
    never with the announced length.
    """

    def __init__(self, limit: int) -> None:
        self.limit = limit
        """Longest frame accepted [bytes]; may change between two frames."""
        self.on_note: Callable[[bytes], bytes | None] | None = None
        """Called with each note, if notes are accepted; returns the content of the frame it announces, if any."""
        self._shared: memoryview
        """Buffer of the reading thread."""
        self._rest = b""
        """Received part of a short frame."""
        self._long_frame: memoryview | None = None
        """Buffer of a long frame, length prefix included."""
        self._filled = 0
        self._expected = 0
        """Size of the last frame with its prefix, if that was long: the next may be as long."""

    def get_buffer(self) -> memoryview:
        """Buffer for the next bytes; valid until the next call for any connection of this thread."""
        if self._long_frame is None and self._expected:
            self._long_frame = _copied(self._rest, self._expected)
            self._filled, self._rest = len(self._rest), b""
        if self._long_frame is not None:
            return self._long_frame[self._filled :]
        self._shared = _shared_buffer()
        self._shared[: len(self._rest)] = self._rest
        return self._shared[len(self._rest) :]

    def receive(
        self, recv_into: "Callable[[memoryview], int]", split: Split
    ) -> tuple[Sequence[Any], int, Iterable[bytes | memoryview]]:
        """Receive once.

        Args:
            recv_into: socket's method.
            split: splits the buffer into frames, and may decode them.

        Returns:
            What `split` returned for the whole short frames, the count of bytes received, and the contents of the
            other frames, as `decode` yields them.
        """
        room, filled = self.get_buffer(), len(self._rest)
        if self._long_frame is not None:
            count = recv_into(room)
            return (), count, self.decode(count)
        contents, start, count = split(recv_into, room, self._shared, filled, self.limit)
        if start < filled + count:
            return contents, count, self.decode(count, start)
        self._rest = b""
        return contents, count, ()

    def decode(self, count: int, start: int = 0) -> Iterator[bytes | memoryview]:
        """Process `count` received bytes; yield the complete frames without their length prefixes.

        Args:
            count: bytes received since the last call.
            start: offset of the first frame that `receive` did not return.

        Raises:
            WireError: the announced length exceeds `limit`.
        """
        data, end = (
            (self._shared, len(self._rest) + count)
            if self._long_frame is None
            else (self._long_frame, self._filled + count)
        )
        size = 0
        while (begin := start + LENGTH.size) <= end:
            (size,) = LENGTH.unpack_from(data, start)
            if size > self.limit:
                if self.on_note is None or not _NOTE <= size <= _NOTE + _MAX_NOTE_BYTES:
                    raise WireError(f"a frame of {size} bytes is announced, more than the {self.limit} accepted")
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
            fills_buffer = data is self._long_frame and start == len(data)
            yield data[begin:start].toreadonly() if fills_buffer and self._expected else bytes(data[begin:start])
            size = 0
        rest, size = data[start:end], size + LENGTH.size
        if size <= _LONG_BYTES:
            self._long_frame, self._rest = None, bytes(rest)
            return
        if data is not self._long_frame or start or end == len(data):
            self._long_frame = _copied(rest, min(size, max(2 * len(rest), self._expected, _TRUST_BYTES)))
        self._rest, self._filled = b"", len(rest)


def _uninitialized(size: int) -> memoryview:
    """Allocate without clearing, which would take as long as writing an image."""
    return _numpy().empty(size, "u1").data


@cache
def _numpy() -> Any:
    import numpy  # lazy: short messages do not need it

    return numpy


def _copied(data: bytes | memoryview, size: int) -> memoryview:
    """Copy to the start of new, uninitialized memory."""
    buffer = _uninitialized(size)
    buffer[: len(data)] = data
    return buffer


def _shared_buffer() -> memoryview:
    if not hasattr(_thread_local, "buffer"):
        _thread_local.buffer = memoryview(bytearray(_SHARED_BYTES))
    return _thread_local.buffer
