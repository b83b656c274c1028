"""Bag file opened for reading."""

import functools
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from trundle.ros import BagConnection, BagError, BagMessage, BagReader, UnindexedBagError, open_bag, recover_messages

from .exceptions import ROSBagEncryptNotSupportedException, ROSBagException, ROSBagUnindexedException


class ReadFile:
    """Connections, counts and messages of a file; an unindexed one is scanned for them."""

    def __init__(self, path: Path, allow_unindexed: bool) -> None:
        """Open a file.

        Raises:
            ROSBagUnindexedException: the bag has no index, and allow_unindexed is false.
            ROSBagEncryptNotSupportedException: the bag is encrypted.
            ROSBagException: the file is not a bag.
            OSError: the file cannot be opened.
        """
        with path.open("rb") as file:
            if not file.read(1):
                raise ROSBagException("empty file")
        self.path = path
        self.reader: BagReader | None = None
        try:
            self.reader = open_bag(path)
        except UnindexedBagError:
            if not allow_unindexed:
                raise ROSBagUnindexedException from None
        except BagError as error:
            if "recover" in str(error) or "reindex" in str(error):
                raise ROSBagUnindexedException from None
            if "encryption" in str(error):
                raise ROSBagEncryptNotSupportedException(
                    f"{error} Decrypt it on the recording machine: rosbag decrypt {path.name}"
                ) from None
            raise ROSBagException(f"This does not appear to be a bag file: {error}") from None

    def messages(
        self,
        is_selected: Callable[[BagConnection], bool] | None = None,
        start_ns: int | None = None,
        end_ns: int | None = None,
    ) -> Iterator[BagMessage]:
        """Yield BagMessages in order of time.

        Raises:
            ROSBagException: the file is damaged.
        """
        try:
            if self.reader is not None:
                yield from self.reader.messages(is_selected, start_ns=start_ns, end_ns=end_ns)
                return
            first = -float("inf") if start_ns is None else start_ns
            last = float("inf") if end_ns is None else end_ns
            for message in recover_messages(self.path):
                if first <= message.stamp_ns <= last and (is_selected is None or is_selected(message.connection)):
                    yield message
        except BagError as error:
            raise ROSBagException(str(error)) from None

    @functools.cached_property
    def stamps_ns(self) -> Mapping[str, Sequence[int]]:
        """Connection's topic → times of its messages [ns], ascending."""
        if self.reader is not None:
            return self.reader.stamps_ns()
        stamps: dict[str, list[int]] = {}
        for message in self.messages():
            stamps.setdefault(message.connection.topic, []).append(message.stamp_ns)
        return {topic: sorted(times) for topic, times in stamps.items()}

    @functools.cached_property
    def counts(self) -> dict[BagConnection, int]:
        """Connection → number of its messages."""
        if self.reader is not None:
            return dict(zip(self.reader.connections, self.reader.counts, strict=True))
        counts: dict[BagConnection, int] = {}
        for message in self.messages():
            counts[message.connection] = counts.get(message.connection, 0) + 1
        return counts

    @property
    def chunks(self) -> Sequence[Any]:
        """Chunks of the file."""
        return self.reader.chunks if self.reader is not None else []

    def close(self) -> None:
        """Close the file."""
        if self.reader is not None:
            self.reader.close()
