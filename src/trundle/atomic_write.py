"""Files that a command is asked to write: whole or not at all."""

import os
import shutil
from pathlib import Path

from .diagnostics import UsageError


def write_atomically(path: Path, text: str) -> None:
    """Write a text as UTF-8; a file that is there keeps what it holds until the new text is on the disk.

    Who may read it stays, a link stays one, and what is no file, a pipe or /dev/stdout, is written into.

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
        half.unlink(missing_ok=True)  # of a program that was killed, or a link that another user put there
        with half.open("x", encoding="utf-8") as file:
            if path.exists():
                shutil.copymode(path, half)
            file.write(text)
        os.replace(half, path)
    except OSError:
        half.unlink(missing_ok=True)
        raise
