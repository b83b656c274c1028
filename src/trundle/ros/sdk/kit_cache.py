"""Compiled kits in the user's cache: those of old releases and compilers are removed."""

import contextlib
import os
import shutil
import time
from collections import Counter
from pathlib import Path

from trundle.base.atomic_write import write_atomically
from trundle.base.file_lock import FileLock

READY = "ready"
"""File in the folder of a compiled kit; it names the compiler, and its time is that of the last use."""
_SPACES, _KIT = "devel_spaces", ".trundle_kit"
_PER_COMPILER = 4
_MAX_BYTES = 1 << 28
_UNFINISHED_S = 24 * 3600


def mark_used(folder: Path, compiler: str) -> None:
    """Note that a kit is compiled, and used now."""
    (folder / READY).write_text(compiler, encoding="utf-8")


def note_workspace(folder: Path, devel: Path) -> None:
    """Note in a devel space the kit with which its programs are linked, and in the kit the devel space."""
    write_atomically(devel / _KIT, str(folder))
    spaces = _spaces(folder)
    if str(devel) not in spaces:
        write_atomically(folder / _SPACES, "\n".join([*spaces, str(devel)]))


def trim(root: Path, used: Path) -> None:
    """Remove kits except for those of workspaces, and the last used four of each compiler, within 256 MiB.

    A kit that another program builds stays.

    Args:
        root: folder of kits.
        used: kit that stays.
    """
    others = (folder for folder in root.iterdir() if folder.is_dir() and folder != used and not _is_linked(folder))
    kits = sorted(others, key=_used_at, reverse=True)
    of_compiler = Counter([_compiler(used)])
    size = _bytes(used)
    for folder in kits:
        if not (folder / READY).exists():
            if time.time() - folder.stat().st_mtime > _UNFINISHED_S:
                _remove(folder)
            continue
        of_compiler[_compiler(folder)] += 1
        size += _bytes(folder)
        if of_compiler[_compiler(folder)] > _PER_COMPILER or size > _MAX_BYTES:
            _remove(folder)


def _is_linked(folder: Path) -> bool:
    """True if the programs of a workspace are linked with a kit."""
    for space in _spaces(folder):
        with contextlib.suppress(OSError):
            if (Path(space) / _KIT).read_text(encoding="utf-8") == str(folder):
                return True
    return False


def _spaces(folder: Path) -> list[str]:
    path = folder / _SPACES
    return path.read_text(encoding="utf-8", errors="replace").splitlines() if path.exists() else []


def _used_at(folder: Path) -> float:
    ready = folder / READY
    return ready.stat().st_mtime if ready.exists() else 0.0


def _compiler(folder: Path) -> str:
    return (folder / READY).read_text(encoding="utf-8", errors="replace")


def _bytes(folder: Path) -> int:
    return sum(os.lstat(os.path.join(root, name)).st_size for root, _, names in os.walk(folder) for name in names)


def _remove(folder: Path) -> None:
    with contextlib.suppress(OSError):  # in use, or another user's
        lock = FileLock(folder)
        try:
            (folder / READY).unlink(missing_ok=True)  # first, so that no build takes half a kit
            shutil.rmtree(folder, ignore_errors=True)
        finally:
            lock.release()
