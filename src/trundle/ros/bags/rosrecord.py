"""Bags of format 1.2, as rosrecord wrote them until 2010: http://wiki.ros.org/Bags/Format/1.2."""

import struct
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import replace
from operator import itemgetter
from pathlib import Path
from typing import Self

from .bag import BagConnection, BagError, BagMessage, Chunk, ConnectionFilter, UnindexedBagError
from .scan import BoundedFile, TruncatedError, operation, read_head

_DEFINITION, _MESSAGE, _FILE_HEADER = 1, 2, 3

_Entry = tuple[int, BagConnection, int, int]
"""A message: stamp [ns], connection, offset and length of the data [bytes]."""


class RosrecordReader:
    """Reader of a 1.2 bag; scans all records, since the optional index adds nothing."""

    def __init__(self, path: Path) -> None:
        self.path = path
        scan = _RecordScan(path)
        if scan.is_truncated or scan.index_offset == 0:
            raise UnindexedBagError(path)
        self.version = "1.2 (unindexed)" if scan.index_offset is None else "1.2"
        self.connections = list(scan.connections.values())
        counts = Counter(connection.topic for _, connection, *_ in scan.entries)
        self.counts = [counts[connection.topic] for connection in self.connections]
        self.chunks: list[Chunk] = []
        self._entries = sorted(scan.entries, key=itemgetter(0))
        self.start_ns, self.end_ns = (self._entries[i][0] if self._entries else 0 for i in (0, -1))

    def messages(
        self, select: ConnectionFilter | None = None, *, start_ns: int | None = None, end_ns: int | None = None
    ) -> Iterator[BagMessage]:
        """See `BagReader`."""
        selected = {connection for connection in self.connections if select is None or select(connection)}
        first = self.start_ns if start_ns is None else start_ns
        last = self.end_ns if end_ns is None else end_ns
        return _read(
            self.path, (entry for entry in self._entries if first <= entry[0] <= last and entry[1] in selected)
        )

    def stamps_ns(self) -> dict[str, list[int]]:
        """See `BagReader`."""
        stamps: dict[str, list[int]] = {}
        for stamp, connection, *_ in self._entries:
            stamps.setdefault(connection.topic, []).append(stamp)
        return stamps

    def close(self) -> None:
        """No-op: the file is open only while messages are read."""

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def scan_rosrecord(path: Path) -> Iterator[BagMessage]:
    """Yield all complete messages of a possibly truncated bag, in file order."""
    return _read(path, _RecordScan(path).entries)


class _RecordScan:
    """Positions of messages in a file, up to the first invalid record."""

    def __init__(self, path: Path) -> None:
        self.connections: dict[bytes, BagConnection] = {}
        """Topic → its first definition."""
        self.entries: list[_Entry] = []
        self.index_offset: int | None = None
        """Offset of the index; 0: never written; None: the bag has none."""
        self.is_truncated = False
        with path.open("rb") as stream:
            version = stream.readline()
            file = BoundedFile(stream, path.stat().st_size - len(version))
            try:
                while head := read_head(file):
                    self._read_record(head[0], file.skip(head[1]), head[1])
            except (TruncatedError, KeyError, struct.error):
                self.is_truncated = True

    def _read_record(self, fields: dict[str, bytes], offset: int, size: int) -> None:
        kind = operation(fields)
        if kind == _FILE_HEADER:
            (self.index_offset,) = struct.unpack("<Q", fields["index_pos"])
        elif kind == _DEFINITION:
            topic, type_, md5sum, definition = (
                fields[name].decode("utf-8", "replace") for name in ("topic", "type", "md5", "def")
            )
            connection = BagConnection(topic=topic, type=type_, md5sum=md5sum, definition=definition)
            self.connections.setdefault(fields["topic"], connection)
        elif kind == _MESSAGE:
            seconds, nanoseconds = struct.unpack("<II", fields["sec"] + fields["nsec"])
            connection = self.connections.get(fields["topic"]) or self._find_definition(fields)
            self.entries.append((seconds * 10**9 + nanoseconds, connection, offset, size))

    def _find_definition(self, fields: dict[str, bytes]) -> BagConnection:
        """Use another topic's definition of the same type."""
        type_ = fields["type"].decode("utf-8", "replace")
        for connection in self.connections.values():
            if connection.type == type_:
                topic = fields["topic"].decode("utf-8", "replace")
                return self.connections.setdefault(fields["topic"], replace(connection, topic=topic))
        raise TruncatedError


def _read(path: Path, entries: Iterable[_Entry]) -> Iterator[BagMessage]:
    with path.open("rb") as file:
        for stamp_ns, connection, offset, size in entries:
            file.seek(offset)
            data = file.read(size)
            if len(data) != size:
                raise BagError(f"{path} was truncated while it was read")
            yield BagMessage(connection, stamp_ns, data)
