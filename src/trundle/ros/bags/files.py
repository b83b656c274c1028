"""Opens bags by content, creates them by file name, and recovers unindexed ones."""

import re
from collections.abc import Generator, Iterator
from contextlib import contextmanager
from pathlib import Path

from trundle.base.file_lock import FileLock
from trundle.base.files import open_file

from .bag import BagError, BagMessage, BagReader, BagWriter

_MCAP_MAGIC = b"\x89MCAP0\r\n"
_VERSION = re.compile(rb"#ROS.* V(\d\.\d)")
_MAX_LINE_BYTES = 64
"""Maximum length of the version line [bytes]."""


def is_bag(path: Path) -> bool:
    """True if a file begins like a ROS bag or an MCAP file.

    Raises:
        BagError: the file cannot be read, or is a bag of an unsupported format.
    """
    return _format(path) != ""


def open_bag(path: Path | str) -> BagReader:
    """Open a .bag or .mcap file for reading.

    Raises:
        UnindexedBagError: the bag has no index.
        BagError: the file is neither, or damaged.
    """
    path = Path(path)
    match _format(path):
        case "mcap":
            from .mcap import McapReader

            return McapReader(path)
        case "1.2":
            from .rosrecord import RosrecordReader

            return RosrecordReader(path)
        case _:
            from .ros1 import Ros1Reader

            return Ros1Reader(path)


def create_bag(path: Path, *, compression: str = "none", chunk_bytes: int = 768 * 1024) -> BagWriter:
    """Create a bag: MCAP if `.mcap` is among the name's suffixes, else ROS 1.

    Args:
        path: new file.
        compression: none, bz2 (.bag only), lz4, or zstd (.mcap only).
        chunk_bytes: chunk size.

    Raises:
        BagError: the file exists, cannot be written, or its format lacks the compression.
    """
    if ".mcap" in path.suffixes:
        from .mcap import McapWriter

        return McapWriter(path, compression=compression, chunk_bytes=chunk_bytes)
    if compression not in ("none", "bz2", "lz4"):
        raise BagError(f"{compression} compression is not supported in ROS 1 bags; use bz2 or lz4")
    from .ros1 import Ros1Writer

    return Ros1Writer(path, compression=compression, chunk_bytes=chunk_bytes)


def lock_bag(path: Path) -> FileLock:
    """Lock a bag's name for writing, with or without the suffix `.active` of an incomplete bag.

    Raises:
        BagError: another program writes the bag, or its folder is not writable.
    """
    try:
        return FileLock(path.with_name(path.name.removesuffix(".active")))
    except OSError as error:
        raise BagError(f"{path} cannot be written: {error.strerror}") from None


@contextmanager
def replaced_bag(path: Path, *, compression: str = "none", backup: Path | None = None) -> Generator[BagWriter]:
    """Yield a writer of a new bag, which replaces the one at `path` at the end unless an error occurs.

    Args:
        path: bag to replace.
        compression: see `create_bag`.
        backup: new name of the replaced bag; None: it is deleted.

    Raises:
        BagError: the bag cannot be written, or another program writes it.
    """
    part = path.with_name(f"{path.name}.part")
    with lock_bag(path):
        part.unlink(missing_ok=True)
        writer = None
        try:
            writer = create_bag(part, compression=compression)
            yield writer
            writer.close()
            if backup is not None:
                path.replace(backup)
            part.replace(path)
        except BaseException as error:
            if writer is not None:
                writer.abandon()
            part.unlink(missing_ok=True)
            if isinstance(error, OSError):
                raise BagError(f"{path} cannot be written: {error.strerror}") from None
            raise


def recover_messages(path: Path) -> Iterator[BagMessage]:
    """Yield all complete messages of a bag, indexed or not, in file order.

    Raises:
        BagError: the file is not a bag.
    """
    path = Path(path)
    match _format(path):
        case "mcap":
            from .mcap import scan_mcap

            return scan_mcap(path)
        case "1.2":
            from .rosrecord import scan_rosrecord

            return scan_rosrecord(path)
        case _:
            from .scan import scan_bag

            return scan_bag(path)


def _format(path: Path) -> str:
    """`mcap`, or the version in the first line of a ROS 1 bag; '' if there is none."""
    try:
        with open_file(path) as file:
            start = file.readline(_MAX_LINE_BYTES)
    except OSError as error:
        raise BagError(f"bag file [{path}] cannot be read: {error.strerror}") from None
    if start.startswith(_MCAP_MAGIC):
        return "mcap"
    version = _VERSION.match(start)
    if version is None:
        return ""
    if version[1] not in (b"1.2", b"2.0"):
        raise BagError(f"{path} is a bag of format {version[1].decode()}; only 1.2 and 2.0 are supported, as by rosbag")
    return version[1].decode()
