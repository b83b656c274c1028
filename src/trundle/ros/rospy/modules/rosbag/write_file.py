"""A bag file that is written: new, or an old one with more at its end."""

import contextlib
import os
from pathlib import Path

from trundle.base.file_lock import FileLock
from trundle.ros import BagConnection, BagError, BagMessage, create_bag, recover_messages

from .exceptions import ROSBagException


class WriteFile:
    """Writes messages, and knows what it wrote.

    An old file is copied to a new one beside it, which takes its place when it is closed: until then the old one
    stays as it was.
    """

    def __init__(self, path: Path, compression, chunk_threshold, *, append):
        """Create or continue a file.

        Raises:
            ROSBagException: the file to continue is no bag.
            OSError: it cannot be written, or another program writes it.
        """
        self.path = path
        self.counts = {}
        self.stamps_ns = {}
        self.chunks = []
        self._by_topic = {}
        self._options = {"compression": compression, "chunk_bytes": max(chunk_threshold, 1)}
        is_old = append and path.exists() and path.stat().st_size > 0
        self._written = path.with_name(f".{path.name}.appending{path.suffix}") if is_old else path
        self._lock = FileLock(path)
        with self._written.open("wb"):  # an OSError of the operating system, as open() has it
            pass
        self._written.unlink()
        self._writer = create_bag(self._written, **self._options)
        if is_old:
            self._copy_old()

    def write(self, connection, stamp_ns, data):
        """Append a message."""
        self._writer.write(BagMessage(connection, stamp_ns, data))
        self.counts[connection] = self.counts.get(connection, 0) + 1
        self.stamps_ns.setdefault(connection.topic, []).append(stamp_ns)

    def connection(self, topic, type_name, md5sum, definition, header):
        """Connection of a topic: the one it has, or a new one."""
        if topic not in self._by_topic:
            given = {key: _text(value) for key, value in (header or {}).items()}
            self._by_topic[topic] = BagConnection(
                topic=topic,
                type=given.get("type", type_name),
                md5sum=given.get("md5sum", md5sum),
                definition=given.get("message_definition", definition),
                caller=given.get("callerid", ""),
                latching=given.get("latching", "0") == "1",
            )
        return self._by_topic[topic]

    def topic_type(self, topic):
        """Connection of a topic that was written before; None if it was not."""
        return self._by_topic.get(topic)

    def messages(self, wanted=None, start_ns=None, end_ns=None):
        """Yield what was written so far, in order of time."""
        self.flush()
        found = [message for message in recover_messages(self._written) if wanted is None or wanted(message.connection)]
        first = -float("inf") if start_ns is None else start_ns
        last = float("inf") if end_ns is None else end_ns
        yield from sorted((m for m in found if first <= m.stamp_ns <= last), key=lambda message: message.stamp_ns)

    def flush(self):
        """Write what is buffered."""
        self._writer.flush()

    @property
    def size(self):
        """Bytes so far."""
        return self._writer.size

    def close(self):
        """Write the index."""
        self._writer.close()
        if self._written != self.path:
            os.replace(self._written, self.path)
        self._lock.release()

    def _copy_old(self):
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


def _text(value):
    return value.decode(errors="replace") if isinstance(value, bytes) else str(value)
