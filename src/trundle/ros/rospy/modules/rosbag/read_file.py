"""A bag file opened for reading."""

import functools
from pathlib import Path

from trundle.ros import BagError, UnindexedBagError, open_bag, recover_messages

from .exceptions import ROSBagEncryptNotSupportedException, ROSBagException, ROSBagUnindexedException


class ReadFile:
    """Connections, counts and messages of a file; those of an unindexed one by a scan."""

    def __init__(self, path: Path, allow_unindexed):
        """Open a file.

        Raises:
            ROSBagUnindexedException: the bag has no index, and that is not allowed.
            ROSBagEncryptNotSupportedException: the bag is encrypted.
            ROSBagException: the file is no bag.
            OSError: the file cannot be opened.
        """
        with path.open("rb") as file:
            if not file.read(1):
                raise ROSBagException("empty file")
        self.path = path
        self.reader = None
        try:
            self.reader = open_bag(path)
        except UnindexedBagError:
            if not allow_unindexed:
                raise ROSBagUnindexedException from None
        except BagError as error:
            if "recover" in str(error) or "reindex" in str(error):
                raise ROSBagUnindexedException from None
            if "encryption" in str(error):
                what = f"{error} Decrypt it where it was written: rosbag decrypt {path.name}"
                raise ROSBagEncryptNotSupportedException(what) from None
            raise ROSBagException(f"This does not appear to be a bag file: {error}") from None

    def messages(self, wanted=None, start_ns=None, end_ns=None):
        """Yield trundle's BagMessages in order of time.

        Raises:
            ROSBagException: the file is damaged.
        """
        try:
            if self.reader is not None:
                yield from self.reader.messages(wanted, start_ns=start_ns, end_ns=end_ns)
                return
            first = -float("inf") if start_ns is None else start_ns
            last = float("inf") if end_ns is None else end_ns
            for message in recover_messages(self.path):
                if first <= message.stamp_ns <= last and (wanted is None or wanted(message.connection)):
                    yield message
        except BagError as error:
            raise ROSBagException(str(error)) from None

    @functools.cached_property
    def stamps_ns(self):
        """Connection's topic → times of its messages [ns], ascending."""
        if self.reader is not None:
            return self.reader.stamps_ns()
        stamps = {}
        for message in self.messages():
            stamps.setdefault(message.connection.topic, []).append(message.stamp_ns)
        return {topic: sorted(times) for topic, times in stamps.items()}

    @functools.cached_property
    def counts(self):
        """Connection → number of its messages."""
        if self.reader is not None:
            return dict(zip(self.reader.connections, self.reader.counts, strict=True))
        counts = {}
        for message in self.messages():
            counts[message.connection] = counts.get(message.connection, 0) + 1
        return counts

    @property
    def chunks(self):
        """Chunks of the file."""
        return self.reader.chunks if self.reader is not None else []

    def close(self):
        """Close the file."""
        if self.reader is not None:
            self.reader.close()
