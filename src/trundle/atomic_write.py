"""Atomic writing of output files."""

import os
import shutil
from pathlib import Path

from .diagnostics import UsageError


def write_atomically(path: Path, text: str) -> None:
    """Write a text as UTF-8; an existing file keeps its content until the new one is on disk.

    Permissions and symbolic links are kept; pipes and devices such as /dev/stdout are written directly.

    Raises:
        UsageError: it cannot be written.
    """
    try:
        if path.exists() and not path.is_file():
            path.write_text(text, encoding="utf-8")
        else:
            _replace(path.resolve(), text)
    except OSError as error:
        raise UsageError(f"cannot write {path}: {error.strerror}") from None


def _replace(path: Path, text: str) -> None:
    half = path.with_name(f".{path.name}.part")
    try:
        half.unlink(missing_ok=True)  # left by a killed program, or a link placed by another user
        with half.open("x", encoding="utf-8") as file:
            if path.exists():
                shutil.copymode(path, half)
            file.write(text)
        os.replace(half, path)
    except OSError:
        half.unlink(missing_ok=True)
        raise
