"""What a bag holds, whatever its format, and what readers and writers of bags can do."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol, Self

from ..errors import RosError


class BagError(RosError):
    """A file that is no bag, is damaged, or cannot be written."""


def recording_failure(path: Path, error: OSError) -> str:
    """Why recording into a file broke off, and what becomes of what it holds."""
    return f"{path}: {error.strerror}; trundle bag reindex makes a bag of what it holds"


class UnindexedBagError(BagError):
    """A bag whose recording was cut off; its messages are there but not its index."""

    def __init__(self, path: Path) -> None:
        super().__init__(f"bag unindexed: {path}.  Run trundle bag reindex.")


@dataclass(frozen=True, slots=True, kw_only=True)
class BagConnection:
    """One publisher's link, as it was recorded."""

    topic: str
    type: str
    md5sum: str
    definition: str
    caller: str = ""
    latching: bool = False


@dataclass(frozen=True, slots=True)
class BagMessage:
    """One message."""

    connection: BagConnection
    stamp_ns: int
    """When it was recorded [ns]."""
    data: bytes


@dataclass(frozen=True, slots=True, kw_only=True)
class Chunk:
    """A stretch of a bag that is compressed as one."""

    compression: str
    size: int
    """[bytes], uncompressed."""
    compressed: int
    """[bytes], in the file."""


ConnectionFilter = Callable[[BagConnection], bool]


class BagReader(Protocol):
    """Reads one bag."""

    path: Path
    version: str
    connections: list[BagConnection]
    counts: list[int]
    """Messages of each connection."""
    chunks: list[Chunk]
    start_ns: int
    end_ns: int
    """First and last message [ns]; both 0 in an empty bag."""

    def messages(
        self, wanted: ConnectionFilter | None = None, *, start_ns: int | None = None, end_ns: int | None = None
    ) -> Iterator[BagMessage]:
        """Yield messages in the order of their stamps, from `start_ns` on and up to `end_ns`.

        Raises:
            BagError: the file is damaged.
        """
        ...

    def close(self) -> None:
        """Close the file."""
        ...

    def __enter__(self) -> Self: ...

    def __exit__(self, *_: object) -> None: ...


class BagWriter(Protocol):
    """Writes one bag."""

    def write(self, message: BagMessage) -> None:
        """Add a message."""
        ...

    def flush(self) -> None:
        """Hand everything so far to the operating system, so that not even SIGKILL loses it."""
        ...

    @property
    def size(self) -> int:
        """About how large the file would be if it were closed now [bytes]."""
        ...

    def close(self) -> None:
        """Write the index and close the file."""
        ...

    def abandon(self) -> None:
        """Close the file as it is, without an index: what is on the disk stays readable by `recovered`."""
        ...

    def __enter__(self) -> Self: ...

    def __exit__(self, *_: object) -> None: ...
