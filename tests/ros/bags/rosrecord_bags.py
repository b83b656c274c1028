"""Bags of format 1.2, identical to the byte to rosrecord's."""

import struct
from collections.abc import Sequence

from trundle.ros import BagMessage

_HEADER = 4096
"""[bytes] of the record at the start, padding included."""


def rosrecord_bag(messages: Sequence[BagMessage], *, has_index: bool = True, is_closed: bool = True) -> bytes:
    """Return the bytes of a bag; `is_closed=False` omits the index that the file header announces."""
    start = b"#ROSRECORD V1.2\n"
    body = b""
    index: dict[str, list[tuple[int, int]]] = {}
    for message in messages:
        topic = message.connection.topic
        offset = len(start) + len(body) + (_HEADER if has_index else 0)
        kind = {"topic": topic, "md5": message.connection.md5sum, "type": message.connection.type}
        if topic not in index:
            body += record({"op": b"\x01", **kind, "def": message.connection.definition})
        sec, nsec = divmod(message.stamp_ns, 10**9)
        body += record({"op": b"\x02", **kind, "sec": _u32(sec), "nsec": _u32(nsec)}, message.data)
        index.setdefault(topic, []).append((message.stamp_ns, offset))
    if not has_index:
        return start + body
    index_offset = len(start) + _HEADER + len(body)
    for topic, entries in index.items() if is_closed else ():
        positions = b"".join(struct.pack("<IIQ", *divmod(stamp_ns, 10**9), offset) for stamp_ns, offset in entries)
        body += record({"op": b"\x04", "topic": topic, "ver": _u32(0), "count": _u32(len(entries))}, positions)
    return start + _file_header(index_offset if is_closed else 0) + body


def record(fields: dict[str, str | bytes], data: bytes = b"") -> bytes:
    """One record."""
    header = b""
    for name, value in fields.items():
        field = name.encode() + b"=" + (value.encode() if isinstance(value, str) else value)
        header += _u32(len(field)) + field
    return _u32(len(header)) + header + _u32(len(data)) + data


def _file_header(index_offset: int) -> bytes:
    empty = record({"op": b"\x03", "index_pos": struct.pack("<Q", index_offset)})
    padding = _HEADER - len(empty)
    return empty[:-4] + _u32(padding) + b" " * padding


def _u32(value: int) -> bytes:
    return struct.pack("<I", value)
