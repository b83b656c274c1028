"""rosbag's Bag, over Trundle's readers and writers."""

import collections
import io
import time
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from types import TracebackType
from typing import Any, Self

import genpy
import roslib.names
import rospy
from trundle.ros import BagConnection, BagSummary, byte_text

from .bag_tuples import (
    BagMessage,
    BagMessageWithConnectionHeader,
    CompressionTuple,
    TopicTuple,
    TypesAndTopicsTuple,
    median_frequency,
)
from .exceptions import ROSBagEncryptNotSupportedException, ROSBagException
from .message_class import message_class
from .read_file import ReadFile
from .streams import SpooledStream
from .write_file import WriteFile


class Compression:
    """Compressions of chunks."""

    NONE = "none"
    BZ2 = "bz2"
    LZ4 = "lz4"


_COMPRESSIONS = (Compression.NONE, Compression.BZ2, Compression.LZ4)


class Bag:
    """A bag, to read or to write; also a context manager and an iterable of its messages."""

    def __init__(
        self,
        f: Any,
        mode: str = "r",
        compression: str = Compression.NONE,
        chunk_threshold: int = 768 * 1024,
        allow_unindexed: bool = False,
        options: Any = None,
        skip_index: bool = False,
    ) -> None:
        """Open a bag.

        Args:
            f: path, or a binary stream.
            mode: r to read, w to write a new file, a to append to an old one.
            compression: a value of `Compression`, when writing.
            chunk_threshold: minimum size of a full chunk [bytes].
            allow_unindexed: open a bag whose recording was interrupted.
            options: {'compression': …, 'chunk_threshold': …}, instead of these arguments.
            skip_index: no effect.

        Raises:
            ValueError: an argument is invalid.
            ROSBagUnindexedException: the bag has no index.
            ROSBagException: the file is not a bag.
            OSError: the file cannot be opened.
        """
        del skip_index
        if options is not None and not isinstance(options, dict):
            raise ValueError("options must be of type dict")
        options = options or {}
        self._compression = _check_compression(options.get("compression", compression))
        self._chunk_threshold = _check_threshold(options.get("chunk_threshold", chunk_threshold))
        if not f:
            raise ValueError("filename (or stream) is invalid")
        if mode not in ("r", "w", "a"):
            raise ValueError(f'mode "{mode}" is invalid')
        self._mode = mode
        self._is_closed = False
        self._stream: SpooledStream | None = None
        if isinstance(f, str | Path):
            self._filename = str(f)
            path = Path(f)
        else:
            self._stream = SpooledStream(f, mode)
            self._filename = getattr(f, "name", None)
            path = self._stream.path
        self._file: ReadFile | WriteFile
        if mode == "r":
            self._file = ReadFile(path, allow_unindexed)
        else:
            self._file = WriteFile(path, self._compression, self._chunk_threshold, append=mode == "a")

    def __iter__(self) -> Iterator[Any]:
        return self.read_messages()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, exc_type: type[BaseException] | None, exc_value: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self.close()

    @property
    def options(self) -> dict[str, Any]:
        """Compression and chunk threshold, as a dictionary."""
        return {"compression": self._compression, "chunk_threshold": self._chunk_threshold}

    @property
    def filename(self) -> Any:
        """Path, as passed to the constructor."""
        return self._filename

    @property
    def version(self) -> int:
        """Format: 102 or 200."""
        reader = getattr(self._file, "reader", None)
        return 102 if reader is not None and reader.version.startswith("1.2") else 200

    @property
    def mode(self) -> str:
        """r, w or a."""
        return self._mode

    @property
    def size(self) -> int:
        """Size of the file [bytes]."""
        file = self._opened()
        return file.size if isinstance(file, WriteFile) else file.path.stat().st_size

    @property
    def compression(self) -> str:
        """Compression of written chunks."""
        return self._compression

    @compression.setter
    def compression(self, compression: str) -> None:
        _check_compression(compression)
        if compression != self._compression:
            raise ROSBagException("the compression of a bag cannot change once it is open; pass it to Bag(…)")

    @property
    def chunk_threshold(self) -> int:
        """Minimum size of a full chunk [bytes]."""
        return self._chunk_threshold

    @chunk_threshold.setter
    def chunk_threshold(self, chunk_threshold: int) -> None:
        self._chunk_threshold = _check_threshold(chunk_threshold)

    def read_messages(
        self,
        topics: str | Iterable[str] | None = None,
        start_time: genpy.Time | None = None,
        end_time: genpy.Time | None = None,
        connection_filter: Callable[..., bool] | None = None,
        raw: bool = False,
        return_connection_header: bool = False,
    ) -> Iterator[Any]:
        """Iterate over BagMessages, in order of time.

        Args:
            topics: one or several topics; default: all.
            start_time: first genpy.Time.
            end_time: last genpy.Time.
            connection_filter: called with (topic, datatype, md5sum, msg_def, header); True selects a connection.
            raw: messages are tuples (type, bytes, MD5, position, class).
            return_connection_header: BagMessageWithConnectionHeader instead of BagMessage.

        Raises:
            ROSBagException: the file is damaged.
        """
        file = self._opened()
        names = None
        if topics:
            topics = [topics] if isinstance(topics, str) else topics
            names = {roslib.names.canonicalize_name(topic) for topic in topics}

        def is_selected(connection: "BagConnection") -> bool:
            if names is not None and connection.topic not in names:
                return False
            return connection_filter is None or connection_filter(
                connection.topic, connection.type, connection.md5sum, connection.definition, _header(connection)
            )

        start_ns, end_ns = (None if limit is None else limit.to_nsec() for limit in (start_time, end_time))
        return self._read(file.messages(is_selected, start_ns, end_ns), raw, return_connection_header)

    def _read(self, messages: Iterable[Any], raw: bool, return_connection_header: bool) -> Iterator[Any]:
        for index, message in enumerate(messages):
            connection = message.connection
            kind = message_class(connection.type, connection.md5sum, connection.definition)
            if raw:
                value = (connection.type, message.data, connection.md5sum, (0, index), kind)
            else:
                value = kind()
                value.deserialize(message.data)
            stamp = rospy.Time(message.stamp_ns // 10**9, message.stamp_ns % 10**9)
            if return_connection_header:
                yield BagMessageWithConnectionHeader(connection.topic, value, stamp, _header(connection))
            else:
                yield BagMessage(connection.topic, value, stamp)

    def flush(self) -> None:
        """Write buffered messages."""
        file = self._opened()
        if isinstance(file, WriteFile):
            file.flush()

    def write(
        self,
        topic: str,
        msg: Any,
        t: genpy.Time | None = None,
        raw: bool = False,
        connection_header: Mapping[str, Any] | None = None,
    ) -> None:
        """Write a message.

        Args:
            topic: topic's name.
            msg: message; with `raw` a tuple as read_messages yields.
            t: genpy.Time of recording; default: now.
            raw: see `msg`.
            connection_header: header of the topic's connection, if this is its first message.

        Raises:
            ValueError: an argument is invalid.
            ROSBagException: a raw message is of an unknown type.
        """
        file = self._opened()
        if not isinstance(file, WriteFile):
            raise io.UnsupportedOperation("write")
        if not topic:
            raise ValueError("topic is invalid")
        if not msg:
            raise ValueError("msg is invalid")
        stamp = genpy.Time.from_sec(time.time()) if t is None else t
        if raw:
            connection, data = self._raw(file, topic, msg, connection_header)
        else:
            buffer = io.BytesIO()
            msg.serialize(buffer)
            data = buffer.getvalue()
            connection = file.connection(topic, msg._type, msg._md5sum, msg._full_text, connection_header)
        file.write(connection, stamp.to_nsec(), data)

    def _raw(
        self, file: WriteFile, topic: str, msg: Any, header: Mapping[str, Any] | None
    ) -> tuple[BagConnection, Any]:
        if len(msg) not in (4, 5):
            raise ValueError("msg must be of length 4 or 5")
        type_name, data, md5sum, pytype = msg[0], msg[1], msg[2], msg[-1]
        connection = file.topic_type(topic)
        if connection is None:
            pytype = pytype or genpy.message.get_message_class(type_name)
            if pytype is None:
                raise ROSBagException(f"cannot locate message class and no message class provided for [{type_name}]")
            connection = file.connection(topic, type_name, md5sum, pytype._full_text, header)
        return connection, data

    def reindex(self) -> Iterator[int]:
        """Iterate over positions while scanning an unindexed bag; its index is written on close."""
        file = self._opened()
        yield 0
        yield sum(file.counts.values()) and self.size

    def close(self) -> None:
        """Close the file; a written one gets its index."""
        if not self._is_closed:
            self._is_closed = True
            self._file.close()
            if self._stream is not None:
                self._stream.close()

    def get_compression_info(self) -> CompressionTuple:
        """Named tuple: prevailing compression, uncompressed size, compressed size [bytes]."""
        chunks = self._file.chunks
        if not chunks:
            return CompressionTuple(self._compression, 0, 0)
        counts = collections.Counter(chunk.compression for chunk in chunks)
        prevailing = max(counts, key=lambda name: (counts[name], name))
        return CompressionTuple(
            prevailing, sum(chunk.size for chunk in chunks), sum(chunk.compressed for chunk in chunks)
        )

    def get_message_count(self, topic_filters: str | Collection[str] | None = None) -> int:
        """Number of messages: of all topics, a topic, or several."""
        if isinstance(topic_filters, str):
            topic_filters = [topic_filters]
        counts = self._file.counts
        return sum(
            count for connection, count in counts.items() if topic_filters is None or connection.topic in topic_filters
        )

    def get_start_time(self) -> float:
        """Time of the first message [s].

        Raises:
            ROSBagException: the bag is empty.
        """
        return genpy.Time(0, min(self._ends()[0])).to_sec()

    def get_end_time(self) -> float:
        """Time of the last message [s].

        Raises:
            ROSBagException: the bag is empty.
        """
        return genpy.Time(0, max(self._ends()[1])).to_sec()

    def _ends(self) -> tuple[Sequence[int], Sequence[int]]:
        """First and last stamps of all topics [ns]."""
        file = self._file
        if isinstance(file, ReadFile) and file.reader is not None and any(file.counts.values()):
            return [file.reader.start_ns], [file.reader.end_ns]
        stamps = [times for times in file.stamps_ns.values() if times]
        if not stamps:
            raise ROSBagException("Bag contains no message")
        return [min(times) for times in stamps], [max(times) for times in stamps]

    def get_type_and_topic_info(self, topic_filters: str | Collection[str] | None = None) -> TypesAndTopicsTuple:
        """Named tuple of `msg_types` (type → MD5) and `topics` (name → type, count, connections, frequency [Hz])."""
        if isinstance(topic_filters, str):
            topic_filters = [topic_filters]
        counts, stamps = self._file.counts, self._file.stamps_ns
        types = {entry.type: entry.md5sum for entry in sorted(counts, key=lambda connection: connection.type)}
        topics: dict[str, TopicTuple] = {}
        for name in sorted({connection.topic for connection in counts}):
            if topic_filters is None or name in topic_filters:
                connections = [connection for connection in counts if connection.topic == name]
                total = sum(counts[connection] for connection in connections)
                frequency = median_frequency(sorted(stamps.get(name, [])))
                topics[name] = TopicTuple(connections[0].type, total, len(connections), frequency)
        return TypesAndTopicsTuple(types, topics)

    def set_encryptor(self, encryptor: str | None = None, param: object = None) -> None:
        """Accept `rosbag/NoEncryptor` only.

        Raises:
            ROSBagEncryptNotSupportedException: another encryptor.
        """
        del param
        if encryptor not in (None, "", "rosbag/NoEncryptor"):
            raise ROSBagEncryptNotSupportedException(
                f"encryption ({encryptor}) is not supported; write the bag without it"
            )

    def __str__(self) -> str:
        summary = self._summary()
        return summary.text() if summary else f"path: {self._filename}\nsize: {byte_text(self.size)}"

    def _get_yaml_info(self, key: str | None = None) -> str:
        """Text of `rosbag info --yaml`; with a key: its value."""
        summary = self._summary()
        text = summary.yaml() if summary else f"path: {self._filename}\nsize: {self.size}\nindexed: False\n"
        if key is None:
            return text
        import yaml

        return str(yaml.safe_load(text).get(key, ""))

    def _summary(self) -> BagSummary | None:
        reader = getattr(self._opened(), "reader", None)
        return BagSummary(reader, str(self._filename), with_rates=True) if reader is not None else None

    def _opened(self) -> ReadFile | WriteFile:
        if self._is_closed:
            raise ValueError("I/O operation on closed bag")
        return self._file


def _check_compression(compression: str) -> str:
    if compression not in _COMPRESSIONS:
        raise ValueError(f"compression must be one of: {', '.join(_COMPRESSIONS)}")
    return compression


def _check_threshold(chunk_threshold: int) -> int:
    if chunk_threshold < 0:
        raise ValueError("chunk_threshold must be greater than or equal to zero")
    return chunk_threshold


def _header(connection: BagConnection) -> dict[str, bytes]:
    """Connection header, as bytes."""
    header = {
        "topic": connection.topic,
        "type": connection.type,
        "md5sum": connection.md5sum,
        "message_definition": connection.definition,
    }
    if connection.caller:
        header["callerid"] = connection.caller
    if connection.latching:
        header["latching"] = "1"
    return {key: value.encode() for key, value in header.items()}
