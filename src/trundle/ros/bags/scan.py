"""Sequential scan of a .bag file, with or without index: http://wiki.ros.org/Bags/Format/2.0."""

import bz2
import os
import struct
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO

import lz4.frame

from .bag import BagConnection, BagError, BagMessage, Chunk

_MAGIC = b"#ROSBAG V2.0\n"
_MESSAGE, _CHUNK, _CONNECTION = 2, 5, 7
_LENGTH = struct.Struct("<I")


class TruncatedError(Exception):
    """The file ends or becomes invalid within a record."""


def scan_bag(path: Path) -> Iterator[BagMessage]:
    """Yield all complete messages of a possibly truncated bag, in file order.

    Raises:
        BagError: the file is not a ROS 1 bag.
    """
    connections: dict[int, BagConnection] = {}
    with path.open("rb") as stream:
        file = BoundedFile(stream, path.stat().st_size)
        if file.read(len(_MAGIC)) != _MAGIC:
            raise BagError(f"{path} is not a ROS 1 bag of format 2.0")
        try:
            while head := read_head(file):
                fields, size = head
                if operation(fields) == _CHUNK:
                    yield from _chunk(fields, file, size, connections)
                else:
                    yield from _record(fields, _read_exactly(file, size), connections)
        except TruncatedError:
            return


def _chunk(
    fields: dict[str, bytes], file: "BoundedFile", size: int, connections: dict[int, BagConnection]
) -> Iterator[BagMessage]:
    data = file.read(size)
    try:
        (size_limit,) = _LENGTH.unpack(fields["size"])
    except (KeyError, struct.error):
        raise TruncatedError from None
    inner = _ByteReader(_decompressed(fields.get("compression", b"none").decode("ascii", "replace"), data, size_limit))
    while head := read_head(inner):
        yield from _record(head[0], _read_exactly(inner, head[1]), connections)
    if len(data) != size:
        raise TruncatedError


def _record(fields: dict[str, bytes], data: bytes, connections: dict[int, BagConnection]) -> Iterator[BagMessage]:
    kind = operation(fields)
    try:
        if kind == _CONNECTION:
            (number,) = _LENGTH.unpack(fields["conn"])
            connections.setdefault(number, _connection(fields["topic"], _fields(data)))
        elif kind == _MESSAGE:
            (number,) = _LENGTH.unpack(fields["conn"])
            seconds, nanoseconds = struct.unpack("<II", fields["time"])
            yield BagMessage(connections[number], seconds * 10**9 + nanoseconds, data)
    except (KeyError, struct.error):
        raise TruncatedError from None


def chunk_at(file: BinaryIO, position: int) -> Chunk:
    """Read the sizes of the chunk at a position.

    Raises:
        BagError: there is no chunk at the position.
    """
    try:
        end = file.seek(0, os.SEEK_END)
        head = read_head(BoundedFile(file, end - file.seek(position)))
        if head is None:
            raise TruncatedError
        (size,) = _LENGTH.unpack(head[0]["size"])
    except (TruncatedError, KeyError, struct.error):
        raise BagError(f"no chunk at byte {position}; trundle bag reindex recovers the messages") from None
    return Chunk(compression=head[0]["compression"].decode("ascii", "replace"), size=size, compressed=head[1])


class BoundedFile:
    """File reader that never requests more bytes than the file has, whatever a length field claims."""

    def __init__(self, file: BinaryIO, size: int) -> None:
        self._file = file
        self._remaining = size

    def read(self, size: int) -> bytes:
        """Read at most `size` bytes."""
        piece = self._file.read(min(size, self._remaining))
        self._remaining -= len(piece)
        return piece

    def skip(self, size: int) -> int:
        """Skip `size` bytes; returns their offset in the file.

        Raises:
            TruncatedError: the file is shorter.
        """
        if size > self._remaining:
            raise TruncatedError
        self._remaining -= size
        return self._file.seek(size, os.SEEK_CUR) - size


class _ByteReader:
    """Reader of a decompressed chunk."""

    def __init__(self, data: bytes) -> None:
        self._data = data
        self._offset = 0

    def read(self, size: int) -> bytes:
        """Read at most `size` bytes."""
        piece = self._data[self._offset : self._offset + size]
        self._offset += len(piece)
        return piece


def read_head(file: "BoundedFile | _ByteReader") -> tuple[dict[str, bytes], int] | None:
    """Read a record header; returns its fields and the data length, or None at the end of the file."""
    start = file.read(4)
    if not start:
        return None
    if len(start) != 4:
        raise TruncatedError
    fields = _fields(_read_exactly(file, _LENGTH.unpack(start)[0]))
    return fields, _LENGTH.unpack(_read_exactly(file, 4))[0]


def _read_exactly(file: "BoundedFile | _ByteReader", size: int) -> bytes:
    data = file.read(size)
    if len(data) != size:
        raise TruncatedError
    return data


def _fields(data: bytes) -> dict[str, bytes]:
    fields: dict[str, bytes] = {}
    offset = 0
    while offset < len(data):
        if offset + 4 > len(data):
            raise TruncatedError
        (size,) = _LENGTH.unpack_from(data, offset)
        name, equals, value = data[offset + 4 : offset + 4 + size].partition(b"=")
        if not equals or offset + 4 + size > len(data):
            raise TruncatedError
        fields[name.decode("ascii", "replace")] = value
        offset += 4 + size
    return fields


def operation(fields: dict[str, bytes]) -> int:
    """Opcode of a record; 0 if missing."""
    value = fields.get("op", b"")
    return value[0] if len(value) == 1 else 0


def _connection(topic: bytes, fields: dict[str, bytes]) -> BagConnection:
    text = {name: value.decode("utf-8", "replace") for name, value in fields.items()}
    return BagConnection(
        topic=topic.decode("utf-8", "replace"),
        type=text["type"],
        md5sum=text["md5sum"],
        definition=text["message_definition"],
        caller=text.get("callerid", ""),
        latching=text.get("latching") == "1",
    )


def _decompressed(compression: str, data: bytes, size_limit: int) -> bytes:
    """Decompress a chunk as far as possible, up to its declared size."""
    if compression == "none":
        return data
    try:
        if compression == "bz2":
            return bz2.BZ2Decompressor().decompress(data, size_limit)
        if compression == "lz4":
            return bytes(lz4.frame.LZ4FrameDecompressor().decompress(data, size_limit))  # pyright: ignore[reportUnknownMemberType, reportUnknownArgumentType]
    except (OSError, RuntimeError):
        pass
    raise TruncatedError
