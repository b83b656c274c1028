"""ROS 1 messages in MCAP files (profile `ros1`), with the mcap library: https://mcap.dev/spec/registry."""

import contextlib
import os
import struct
from collections.abc import Generator, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Self

from mcap.exceptions import McapError
from mcap.opcode import Opcode
from mcap.reader import SeekingReader
from mcap.records import Channel, Message, Schema
from mcap.stream_reader import StreamReader
from mcap.writer import CompressionType, Writer

from ..messages.message_library import Messages
from .bag import BagConnection, BagError, BagMessage, Chunk, ConnectionFilter, UnindexedBagError

_MAGIC = b"\x89MCAP0\r\n"
"""Bytes at the start of a file, and at its end unless recording was interrupted."""
_MAX_RECORD_BYTES = 2**30
"""Maximum record length [bytes]."""
_END_NS = 2**63
"""Upper limit of times [ns], in the year 2262."""
_INDEX_HEAD = struct.Struct("<BQHI")
"""Head of a message index: opcode, length, channel, length of the entries; an entry is a time [ns] and an offset, as
u64.
"""


class McapReader:
    """Reader of an indexed .mcap file."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.version = "mcap"
        self._file = path.open("rb")
        try:
            self._open()
        except BaseException:
            self._file.close()
            raise

    def _open(self) -> None:
        self._file.seek(-min(len(_MAGIC), self.path.stat().st_size), os.SEEK_END)
        if self._file.read() != _MAGIC:
            raise UnindexedBagError(self.path)
        self._file.seek(0)
        with _library_errors(self.path):
            self._reader = SeekingReader(self._file, record_size_limit=_MAX_RECORD_BYTES)
            summary = self._reader.get_summary()
        if summary is None or summary.statistics is None:
            raise UnindexedBagError(self.path)
        self._by_id = {
            id_: _connection(self.path, channel, summary.schemas.get(channel.schema_id))
            for id_, channel in summary.channels.items()
        }
        self.connections = list(self._by_id.values())
        statistics = summary.statistics
        self.counts = [statistics.channel_message_counts.get(id_, 0) for id_ in self._by_id]
        self.start_ns, self.end_ns = statistics.message_start_time, statistics.message_end_time
        if statistics.message_count and not self.start_ns <= self.end_ns < _END_NS:
            raise BagError(f"{self.path} is damaged: its messages are from {self.start_ns} to {self.end_ns} ns")
        self._message_count = statistics.message_count
        self._chunk_indexes = summary.chunk_indexes
        self.chunks: list[Chunk] = [
            Chunk(compression=c.compression or "none", size=c.uncompressed_size, compressed=c.compressed_size)
            for c in summary.chunk_indexes
        ]

    def messages(
        self, select: ConnectionFilter | None = None, *, start_ns: int | None = None, end_ns: int | None = None
    ) -> Iterator[BagMessage]:
        """See `BagReader`."""
        stop = None if end_ns is None else end_ns + 1
        with _library_errors(self.path):
            for _, channel, message in self._reader.iter_messages(starting_at=start_ns, ending_before=stop):
                connection = self._by_id[channel.id]
                if select is None or select(connection):
                    yield BagMessage(connection, message.log_time, message.data)

    def stamps_ns(self) -> dict[str, list[int]]:
        """See `BagReader`; read from the index, or from the messages if the index is incomplete."""
        with _library_errors(self.path):
            indexed = self._indexed_ns()
        if sum(map(len, indexed.values())) == self._message_count:
            return {topic: sorted(times) for topic, times in indexed.items()}
        stamps: dict[str, list[int]] = {}
        for message in self.messages():
            stamps.setdefault(message.connection.topic, []).append(message.stamp_ns)
        return stamps

    def _indexed_ns(self) -> dict[str, list[int]]:
        """Topic → times in the index [ns], in the order of the file."""
        stamps: dict[str, list[int]] = {}
        end, size = 0, os.fstat(self._file.fileno()).st_size
        for offset in sorted(
            {position for chunk in self._chunk_indexes for position in chunk.message_index_offsets.values()}
        ):
            self._file.seek(offset)
            head = self._file.read(_INDEX_HEAD.size)
            opcode, _, channel_id, length = _INDEX_HEAD.unpack(head)
            is_after_previous, end = offset >= end, offset + _INDEX_HEAD.size + length
            if opcode != Opcode.MESSAGE_INDEX or not is_after_previous or end > size:
                raise BagError(f"{self.path} is damaged: no index at byte {offset}")
            entries = struct.iter_unpack("<QQ", self._file.read(length))
            stamps.setdefault(self._by_id[channel_id].topic, []).extend(time_ns for time_ns, _ in entries)
        return stamps

    def close(self) -> None:
        """Close the file."""
        self._file.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


class McapWriter:
    """Writer of an .mcap file."""

    def __init__(self, path: Path, *, compression: str = "none", chunk_bytes: int = 768 * 1024) -> None:
        kind = {"none": CompressionType.NONE, "lz4": CompressionType.LZ4, "zstd": CompressionType.ZSTD}.get(compression)
        if kind is None:
            raise BagError(f"{compression} compression is not supported in MCAP files; use lz4 or zstd")
        try:
            self._file = path.open("xb")
        except OSError as error:
            raise BagError(f"{path} cannot be written: {error.strerror}") from None
        self._writer = Writer(self._file, chunk_size=chunk_bytes, compression=kind)
        self._writer.start(profile="ros1", library="trundle")
        self._schemas: dict[tuple[str, str], int] = {}
        self._channels: dict[BagConnection, int] = {}
        self._buffered_bytes = 0

    def write(self, message: BagMessage) -> None:
        """Append a message."""
        channel = self._channels.get(message.connection) or self._add(message.connection)
        self._writer.add_message(channel, message.stamp_ns, message.data, message.stamp_ns)
        self._buffered_bytes += len(message.data)

    def flush(self) -> None:
        """Write all buffered data to the operating system."""
        self._writer.flush()
        self._buffered_bytes = 0

    @property
    def size(self) -> int:
        """Approximate file size [bytes]."""
        return self._file.tell() + self._buffered_bytes

    def close(self) -> None:
        """Write the index and close the file."""
        self._writer.finish()
        self._file.close()

    def abandon(self) -> None:
        """Close the file without an index."""
        with contextlib.suppress(OSError):  # buffered data that could not be written before fails again
            self._file.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _add(self, connection: BagConnection) -> int:
        key = (connection.type, connection.definition)
        if key not in self._schemas:
            self._schemas[key] = self._writer.register_schema(
                connection.type, "ros1msg", connection.definition.encode()
            )
        self._channels[connection] = self._writer.register_channel(
            connection.topic,
            "ros1",
            self._schemas[key],
            {
                "md5sum": connection.md5sum,
                "callerid": connection.caller,
                "latching": str(int(connection.latching)),
            },
        )
        return self._channels[connection]


def scan_mcap(path: Path) -> Iterator[BagMessage]:
    """Yield all complete messages of a possibly truncated file.

    Raises:
        BagError: the messages are not ROS 1 messages.
    """
    schemas: dict[int, Schema] = {}
    connections: dict[int, BagConnection] = {}
    with path.open("rb") as file:
        try:
            for record in StreamReader(file, record_size_limit=_MAX_RECORD_BYTES).records:
                if isinstance(record, Schema):
                    schemas[record.id] = record
                elif isinstance(record, Channel) and record.id not in connections:
                    connections[record.id] = _connection(path, record, schemas.get(record.schema_id))
                elif isinstance(record, Message):
                    yield BagMessage(connections[record.channel_id], record.log_time, record.data)
        except BagError:
            raise
        except Exception:  # truncated or damaged
            return


def _connection(path: Path, channel: Channel, schema: Schema | None) -> BagConnection:
    if channel.message_encoding != "ros1" or schema is None or schema.encoding != "ros1msg":
        raise BagError(f"{path}: {channel.topic} carries {channel.message_encoding} messages; only ros1 is supported")
    type_name, definition = schema.name, schema.data.decode("utf-8", "replace")
    md5sum = channel.metadata.get("md5sum", "")
    if not md5sum:  # MCAP may omit these fields, which connection headers require
        messages = Messages()
        messages.add_definition(type_name, definition)
        md5sum = messages.md5(type_name)
    return BagConnection(
        topic=channel.topic,
        type=type_name,
        md5sum=md5sum,
        definition=definition,
        caller=channel.metadata.get("callerid", ""),
        latching=channel.metadata.get("latching") in ("1", "true"),
    )


@contextmanager
def _library_errors(path: Path) -> Generator[None]:
    """Convert exceptions of the library to a BagError."""
    try:
        yield
    except BagError:
        raise
    except McapError as error:
        raise BagError(f"{path} cannot be read: {error}") from None
    except Exception as error:  # arbitrary bytes cause arbitrary exceptions in the library
        raise BagError(
            f"{path} is damaged: {error or type(error).__name__}; trundle bag reindex recovers its messages"
        ) from None
