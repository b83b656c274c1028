"""Reads files that launch files name, which may be anything."""

from pathlib import Path


def is_file(name: str) -> bool:
    """Tell whether there is such a file; a name that no file could have is none."""
    try:
        return Path(name).is_file()
    except OSError:
        return False


def read_file(name: str) -> bytes:
    """Read a file.

    Raises:
        ValueError: there is none, or it cannot be read; the message says so.
    """
    if not is_file(name):
        raise ValueError(f"no file {name!r}")
    try:
        return Path(name).read_bytes()
    except OSError as error:
        raise ValueError(f"{name!r} cannot be read: {error.strerror}") from None
