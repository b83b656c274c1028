"""TCPROS connection headers and length prefixes."""

from collections.abc import Mapping

from ..errors import WireError
from .framing import LENGTH

MAX_HEADER_BYTES = 4 * 1024 * 1024
"""A header holds a message definition; the longest in a desktop installation is below 100 kB."""
MAX_MESSAGE_BYTES = 1_000_000_000
"""roscpp drops a connection that announces more ("a message of over a gigabyte was predicted")."""


def encode_header(fields: Mapping[str, str]) -> bytes:
    """Encode a connection header with its length prefix."""
    parts: list[bytes] = []
    for name, value in fields.items():
        item = f"{name}={value}".encode()
        parts += (LENGTH.pack(len(item)), item)
    return frame(b"".join(parts))


def decode_header(data: bytes) -> dict[str, str]:
    """Decode a connection header without its length prefix.

    Raises:
        WireError: the header is malformed.
    """
    fields: dict[str, str] = {}
    offset = 0
    while offset < len(data):
        if offset + 4 > len(data):
            raise WireError("a connection header ends within a length")
        (size,) = LENGTH.unpack_from(data, offset)
        item = data[offset + 4 : offset + 4 + size]
        if len(item) != size:
            raise WireError("a connection header is shorter than its length field")
        name, equals, value = item.partition(b"=")
        if not equals:
            raise WireError("a connection header field has no '='")
        fields[name.decode("utf-8", "replace")] = value.decode("utf-8", "replace")
        offset += 4 + size
    return fields


def frame(data: bytes | bytearray | memoryview) -> bytes:
    """Prepend the length."""
    return b"".join((LENGTH.pack(len(data)), data))


def check_md5(requested: str, offered: str) -> bool:
    """True if two md5 sums agree; a requested `*` matches any."""
    return requested in ("*", offered)
