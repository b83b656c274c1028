"""Reading of files named in launch files."""

import os

from trundle import files


def read_file(name: str) -> bytes:
    """Read a file's bytes.

    Raises:
        ValueError: the file does not exist or cannot be read.
    """
    if not os.path.exists(name):
        raise ValueError(f"no file {name!r}")
    try:
        return files.read_file(name)
    except OSError as error:
        raise ValueError(f"{name!r} cannot be read: {error.strerror}") from None
