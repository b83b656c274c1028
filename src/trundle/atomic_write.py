"""Atomic writing of output files."""

import os
import shutil
from pathlib import Path

from .diagnostics import UsageError


def write_atomically(path: Path, content: str | bytes) -> None:
    """Write bytes, or a text as UTF-8; an existing file keeps its content until the new one is on disk.

    Permissions and symbolic links are kept; pipes and devices such as /dev/stdout are written directly.

    Raises:
        UsageError: it cannot be written.
    """
    data = content if isinstance(content, bytes) else content.encode()
    try:
        if path.exists() and not path.is_file():
            path.write_bytes(data)
        else:
            _replace(path.resolve(), data)
    except OSError as error:
        raise UsageError(f"cannot write {path}: {error.strerror}") from None


def _replace(path: Path, data: bytes) -> None:
    half = path.with_name(f".{path.name}.part")
    try:
        half.unlink(missing_ok=True)  # left by a killed program, or a link placed by another user
        with half.open("xb") as file:
            if path.exists():
                shutil.copymode(path, half)
            file.write(data)
        os.replace(half, path)
    except OSError:
        half.unlink(missing_ok=True)
        raise
