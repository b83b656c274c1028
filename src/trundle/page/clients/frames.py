"""WebSocket frames to a client: RFC 6455, 5.2."""

import struct
from typing import TypeAlias

Buffer: TypeAlias = bytes | memoryview
TEXT, BINARY, CLOSE, PING, PONG = 0x81, 0x82, 0x88, 0x89, 0x8A
"""First byte of an unfragmented frame."""


def frame_header(first_byte: int, size: int) -> bytes:
    """Return the header of an unmasked frame."""
    if size < 126:
        return bytes((first_byte, size))
    if size < 65536:
        return struct.pack("!BBH", first_byte, 126, size)
    return struct.pack("!BBQ", first_byte, 127, size)
