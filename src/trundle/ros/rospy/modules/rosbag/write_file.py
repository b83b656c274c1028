"""Bag file opened for writing: a new one, or an old one to append to."""

import contextlib
import os
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

from trundle.base.file_lock import FileLock
from trundle.ros import BagConnection, BagError, BagMessage, create_bag, recover_messages

from .exceptions import ROSBagException


class WriteFile:
    """Writes messages, and keeps their counts and stamps.

    An old file is copied to a new one in the same folder, which replaces it on close; until then the old file stays
    unchanged.
    """

    def __init__(self, path: Path, compression: str, chunk_threshold: int, *, append: bool) -> None:
        """Create a file, or append to one.

        Raises:
            ROSBagException: the file to append to is not a bag.
            OSError: it cannot be written, or another program writes it.
        """
        self.path = path
        self.counts: dict[BagConnection, int] = {}
        self.stamps_ns: dict[str, list[int]] = {}
        self.chunks: list[Any] = []
        self._by_topic: dict[str, BagConnection] = {}
        options: dict[str, Any] = {"compression": compression, "chunk_bytes": max(chunk_threshold, 1)}
        is_old = append and path.exists() and path.stat().st_size > 0
        self._written = path.with_name(f".{path.name}.appending{path.suffix}") if is_old else path
        self._lock = FileLock(path)
        with self._written.open("wb"):  # raises the same OSError as open()
            pass
        self._written.unlink()
        self._writer = create_bag(self._written, **options)
        if is_old:
            self._copy_old()

    def write(self, connection: BagConnection, stamp_ns: int, data: bytes) -> None:
        """Append a message."""
        self._writer.write(BagMessage(connection, stamp_ns, data))
        self.counts[connection] = self.counts.get(connection, 0) + 1
        self.stamps_ns.setdefault(connection.topic, []).append(stamp_ns)

    def connection(
        self, topic: str, type_name: str, md5sum: str, definition: str, header: Mapping[str, Any] | None
    ) -> BagConnection:
        """Connection of a topic: the existing one, or a new one."""
        if topic not in self._by_topic:
            fields = {key: _text(value) for key, value in (header or {}).items()}
            self._by_topic[topic] = BagConnection(
                topic=topic,
                type=fields.get("type", type_name),
                md5sum=fields.get("md5sum", md5sum),
                definition=fields.get("message_definition", definition),
                caller=fields.get("callerid", ""),
                latching=fields.get("latching", "0") == "1",
            )
        return self._by_topic[topic]

    def topic_type(self, topic: str) -> BagConnection | None:
        """Connection of a topic that was written before, else None."""
        return self._by_topic.get(topic)

    def messages(
        self,
        is_selected: Callable[[BagConnection], bool] | None = None,
        start_ns: int | None = None,
        end_ns: int | None = None,
    ) -> Iterator[BagMessage]:
        """Yield the messages written so far, in order of time."""
        self.flush()
        messages = [
            message
            for message in recover_messages(self._written)
            if is_selected is None or is_selected(message.connection)
        ]
        first = -float("inf") if start_ns is None else start_ns
        last = float("inf") if end_ns is None else end_ns
        yield from sorted((m for m in messages if first <= m.stamp_ns <= last), key=lambda message: message.stamp_ns)

    def flush(self) -> None:
        """Write buffered messages."""
        self._writer.flush()

    @property
    def size(self) -> int:
        """Size so far [bytes]."""
        return self._writer.size

    def close(self) -> None:
        """Write the index."""
        self._writer.close()
        if self._written != self.path:
            os.replace(self._written, self.path)
        self._lock.release()

    def _copy_old(self) -> None:
        try:
            for message in recover_messages(self.path):
                self._by_topic.setdefault(message.connection.topic, message.connection)
                self.write(message.connection, message.stamp_ns, message.data)
        except BagError as error:
            self._writer.abandon()
            self._lock.release()
            with contextlib.suppress(OSError):
                self._written.unlink()
            raise ROSBagException(f"This does not appear to be a bag file: {error}") from None


def _text(value: object) -> str:
    return value.decode(errors="replace") if isinstance(value, bytes) else str(value)
