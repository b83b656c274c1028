"""Bag contents, and the protocols of readers and writers of every bag format."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol, Self

from ..errors import RosError


class BagError(RosError):
    """A file that is no bag, is damaged, or cannot be written."""


def recording_failure(path: Path, error: OSError) -> str:
    """Error message for a failed recording."""
    return f"{path}: {error.strerror}; trundle bag reindex --output-dir=FOLDER recovers its messages"


class UnindexedBagError(BagError):
    """A bag without an index, since its recording was interrupted."""

    def __init__(self, path: Path) -> None:
        super().__init__(f"bag unindexed: {path}.  Run trundle bag reindex.")


@dataclass(frozen=True, slots=True, kw_only=True)
class BagConnection:
    """Connection record: one publisher's link to the recorder."""

    topic: str
    type: str
    md5sum: str
    definition: str
    caller: str = ""
    latching: bool = False


@dataclass(frozen=True, slots=True)
class BagMessage:
    """A recorded message, serialized."""

    connection: BagConnection
    stamp_ns: int
    """Time of recording [ns]."""
    data: bytes


@dataclass(frozen=True, slots=True, kw_only=True)
class Chunk:
    """A chunk, compressed as a unit."""

    compression: str
    size: int
    """[bytes], uncompressed."""
    compressed: int
    """[bytes], in the file."""


ConnectionFilter = Callable[[BagConnection], bool]


class BagReader(Protocol):
    """Reader of one bag."""

    path: Path
    version: str
    connections: list[BagConnection]
    counts: list[int]
    """Message count of each connection."""
    chunks: list[Chunk]
    start_ns: int
    end_ns: int
    """Times of the first and last message [ns]; both 0 in an empty bag."""

    def messages(
        self, select: ConnectionFilter | None = None, *, start_ns: int | None = None, end_ns: int | None = None
    ) -> Iterator[BagMessage]:
        """Yield messages of selected connections in order of `stamp_ns`, from `start_ns` to `end_ns` inclusive.

        Raises:
            BagError: the file is damaged.
        """
        ...

    def stamps_ns(self) -> dict[str, list[int]]:
        """Topic → times of its messages [ns], ascending."""
        ...

    def close(self) -> None:
        """Close the file."""
        ...

    def __enter__(self) -> Self: ...

    def __exit__(self, *_: object) -> None: ...


class BagWriter(Protocol):
    """Writer of one bag."""

    def write(self, message: BagMessage) -> None:
        """Append a message."""
        ...

    def flush(self) -> None:
        """Write all buffered data to the operating system, so that it survives SIGKILL."""
        ...

    @property
    def size(self) -> int:
        """Approximate file size if the bag were closed now [bytes]."""
        ...

    def close(self) -> None:
        """Write the index and close the file."""
        ...

    def abandon(self) -> None:
        """Close the file without an index; written chunks are readable by `recover_messages`."""
        ...

    def __enter__(self) -> Self: ...

    def __exit__(self, *_: object) -> None: ...
