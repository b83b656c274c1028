"""ROS 1 bags (format 2.0), with the rosbags library."""

import contextlib
import struct
from collections.abc import Callable, Generator, Iterator
from contextlib import contextmanager
from os import SEEK_END
from pathlib import Path
from typing import Any, BinaryIO, Self, cast

import lz4.frame
from rosbags.rosbag1 import Reader, ReaderError, Writer, WriterError
from rosbags.rosbag1.writer import WriteChunk

from .bag import BagConnection, BagError, BagMessage, Chunk, ConnectionFilter, UnindexedBagError
from .scan import chunk_at


class Ros1Reader:
    """Reader of an indexed .bag file."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.version = "2.0"
        self._reader = Reader(path)
        with _library_errors(path):
            self._reader.open()
        self._by_id = {c.id: _connection(c) for c in self._reader.connections}
        self.connections = [self._by_id[c.id] for c in self._reader.connections]  # damaged bags may repeat an ID
        self.counts = [int(c.msgcount) for c in self._reader.connections]
        infos = self._reader.chunk_infos
        self.start_ns = min((info.start_time for info in infos if info.connection_counts), default=0)
        self.end_ns = max((info.end_time - 1 for info in infos if info.connection_counts), default=0)
        with path.open("rb") as file:
            self.chunks: list[Chunk] = [chunk_at(file, info.pos) for info in infos]

    def messages(
        self, select: ConnectionFilter | None = None, *, start_ns: int | None = None, end_ns: int | None = None
    ) -> Iterator[BagMessage]:
        """See `BagReader`."""
        selected = [c for c in self._reader.connections if select is None or select(self._by_id[c.id])]
        if not selected:
            return
        stop = None if end_ns is None else end_ns + 1
        with _library_errors(self.path):
            for connection, stamp_ns, data in self._reader.messages(selected, start_ns, stop):
                yield BagMessage(self._by_id[connection.id], stamp_ns, data)

    def stamps_ns(self) -> dict[str, list[int]]:
        """See `BagReader`; read from the index."""
        stamps: dict[str, list[int]] = {}
        for connection in self._reader.connections:
            entries = self._reader.indexes.get(connection.id, [])
            stamps.setdefault(connection.topic, []).extend(entry.time for entry in entries)
        return {topic: sorted(times) for topic, times in stamps.items()}

    def close(self) -> None:
        """Close the file."""
        self._reader.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


class Ros1Writer:
    """Writer of a .bag file."""

    def __init__(self, path: Path, *, compression: str = "none", chunk_bytes: int = 768 * 1024) -> None:
        self._writer = _FlushingWriter(path)
        self._writer.chunk_threshold = chunk_bytes
        if compression != "none":
            self._writer.set_compression(Writer.CompressionFormat[compression.upper()])
        if compression == "lz4":
            self._writer.compressor = _lz4
        try:
            self._writer.open()
        except (WriterError, OSError) as error:
            self._writer.abandon()
            reason = error.strerror if isinstance(error, OSError) else error
            raise BagError(f"{path} cannot be written: {reason}") from None
        self._connections: dict[BagConnection, Any] = {}

    def write(self, message: BagMessage) -> None:
        """Append a message."""
        connection = self._connections.get(message.connection) or self._add(message.connection)
        self._writer.write(connection, message.stamp_ns, message.data)

    def flush(self) -> None:
        """Write all buffered data to the operating system."""
        self._writer.flush()

    @property
    def size(self) -> int:
        """Approximate file size [bytes]."""
        return self._writer.size

    def close(self) -> None:
        """Write the index and close the file."""
        self._writer.close()

    def abandon(self) -> None:
        """Close the file without an index."""
        self._writer.abandon()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _add(self, connection: BagConnection) -> Any:
        self._connections[connection] = self._writer.add_connection(
            connection.topic,
            connection.type.replace("/", "/msg/", 1),
            msgdef=connection.definition,
            md5sum=connection.md5sum,
            callerid=connection.caller or None,
            latching=int(connection.latching),
        )
        return self._connections[connection]


def _lz4(data: bytes) -> bytes:
    """Compress for roslz4, which supports neither linked blocks nor a content size in the frame header."""
    compress = cast("Callable[..., bytes]", lz4.frame.compress)  # pyright: ignore[reportUnknownMemberType]
    return compress(data, block_linked=False, content_checksum=True, store_size=False)


_PADDING_AT = 13 + 4 + 69
"""Offset of the bag header's padding length: after the magic line and the fixed-size header."""
_PADDING = 4096 - 69
_MISSING_PADDING = 8
"""`rosbag reindex` expects 4096 bytes in addition to two length fields; rosbags pads to 4096 bytes including them."""


class _FlushingWriter(Writer):
    """rosbags' writer with flushing to disk and without the message index in memory."""

    def open(self) -> None:
        """Open the file, and pad the bag header as rosbag does."""
        super().open()
        assert self.bio is not None
        self.bio.write(b" " * _MISSING_PADDING)
        _write_padding(self.bio)
        self.bio.seek(0, SEEK_END)

    def close(self) -> None:
        """Write the index; rosbags rewrites the bag header with its own padding."""
        super().close()
        with self.path.open("r+b") as file:
            _write_padding(file)

    def abandon(self) -> None:
        """Close the file without an index."""
        if self.bio is not None:
            with contextlib.suppress(OSError):  # buffered data that could not be written before fails again
                self.bio.close()

    def write_chunk(self, chunk: WriteChunk) -> None:
        """Write a chunk; keep only the counts of its index, which closing needs."""
        super().write_chunk(chunk)
        if chunk.pos != -1:
            counts = {id_: cast("list[tuple[int, int]]", range(len(items))) for id_, items in chunk.connections.items()}
            chunk.connections = counts

    def flush(self) -> None:
        """Finish the current chunk."""
        assert self.bio is not None
        self.write_chunk(self.chunks[-1])
        self.bio.flush()

    @property
    def size(self) -> int:
        """Bytes written and buffered."""
        assert self.bio is not None
        return self.bio.tell() + self.chunks[-1].data.tell()


def _write_padding(file: BinaryIO) -> None:
    file.seek(_PADDING_AT)
    file.write(struct.pack("<I", _PADDING))


def _connection(connection: Any) -> BagConnection:
    return BagConnection(
        topic=connection.topic,
        type=connection.msgtype.replace("/msg/", "/", 1),
        md5sum=connection.digest,
        definition=connection.msgdef.data,
        caller=connection.ext.callerid or "",
        latching=bool(connection.ext.latching),
    )


@contextmanager
def _library_errors(path: Path) -> Generator[None]:
    """Convert exceptions of the library to a BagError."""
    try:
        yield
    except ReaderError as error:
        if "not indexed" in str(error) or "index looks damaged" in str(error):
            raise UnindexedBagError(path) from None
        raise BagError(f"{path} cannot be read: {error}") from None
    except BagError:
        raise
    except Exception as error:  # arbitrary bytes cause arbitrary exceptions in the library
        raise BagError(
            f"{path} is damaged: {error or type(error).__name__}; trundle bag reindex recovers its messages"
        ) from None
