"""Reads files that launch files name, which may be anything."""

import os

from trundle import files


def read_file(name: str) -> bytes:
    """Read a file.

    Raises:
        ValueError: there is none, or it cannot be read; the message says so.
    """
    if not os.path.exists(name):
        raise ValueError(f"no file {name!r}")
    try:
        return files.read_file(name)
    except OSError as error:
        raise ValueError(f"{name!r} cannot be read: {error.strerror}") from None
