"""Atomic writing of output files."""

import os
import shutil
from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO

from .diagnostics import UsageError
from .file_lock import FileLock


def write_atomically(path: Path, content: str | bytes | Path, *, replace: bool = True) -> None:
    """Write bytes, a text as UTF-8, or a copy of a file; an existing file is replaced once the new one is complete.

    Permissions and symbolic links are kept; pipes and devices such as /dev/stdout are written directly.

    Raises:
        UsageError: it cannot be written.
        FileExistsError: the file exists, and `replace` is False.
    """
    try:
        if path.exists() and not path.is_file():
            with path.open("wb") as file:
                _fill(file, content)
        else:
            with FileLock(path):
                _write(path.resolve(), content, replace=replace)
    except OSError as error:
        if isinstance(error, FileExistsError) and not replace:
            raise
        raise UsageError(f"cannot write {path}: {error.strerror}") from None


@contextmanager
def replaced_atomically(path: Path) -> Generator[Path]:
    """Yield a temporary file of the same suffix, which replaces `path` at the end, but not after an error.

    A pipe or a device is yielded itself, and written in place.

    Raises:
        OSError: it cannot be written.
    """
    if path.exists() and not path.is_file():
        yield path
        return
    path = path.resolve()
    partial = path.with_name(f".{path.stem}.part{path.suffix}")
    with FileLock(path):
        partial.unlink(missing_ok=True)
        partial.open("xb").close()  # never follow another user's link
        try:
            yield partial
            if path.exists():
                shutil.copymode(path, partial)
            os.replace(partial, path)
        except BaseException:
            partial.unlink(missing_ok=True)
            raise


def _write(path: Path, content: str | bytes | Path, *, replace: bool) -> None:
    partial = path.with_name(f".{path.name}.part")
    try:
        partial.unlink(missing_ok=True)  # the name is left by a killed program, or is another user's link
        with partial.open("xb") as file:
            if path.exists():
                shutil.copymode(path, partial)
            _fill(file, content)
        if replace:
            os.replace(partial, path)
        else:
            _move_new(partial, path)
    except OSError:
        partial.unlink(missing_ok=True)
        raise


def _fill(file: BinaryIO, content: str | bytes | Path) -> None:
    if isinstance(content, Path):
        with content.open("rb") as source:
            shutil.copyfileobj(source, file)
    else:
        file.write(content if isinstance(content, bytes) else content.encode(errors="surrogateescape"))


def _move_new(partial: Path, path: Path) -> None:
    """Move a file to a name that must be free."""
    try:
        os.link(partial, path)
        partial.unlink()
    except FileExistsError:
        raise
    except OSError:  # the disk has no hard links
        path.touch(exist_ok=False)
        os.replace(partial, path)
