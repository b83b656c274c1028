"""Locks on files and folders that only one program may write at a time."""

import contextlib
import errno
import os
from pathlib import Path
from typing import Self

from .diagnostics import printable

try:
    import fcntl
except ModuleNotFoundError:

    def _lock(file: int) -> None:
        import msvcrt

        msvcrt.locking(file, msvcrt.LK_NBLCK, 1)  # pyright: ignore[reportAttributeAccessIssue, reportUnknownMemberType]
else:

    def _lock(file: int) -> None:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)


_FLAGS = os.O_CREAT | sum(getattr(os, name, 0) for name in ("O_NOFOLLOW", "O_NONBLOCK", "O_CLOEXEC"))
_IN_USE = (errno.EAGAIN, errno.EACCES)


class FileLock:
    """Lock on the name of a file, which need not exist, or on a folder; it ends with the process.

    The lock is on a hidden file beside it, or in the folder, which is removed at the end. Devices, pipes, and disks
    without locks are not locked.
    """

    def __init__(self, path: Path) -> None:
        """Lock.

        Raises:
            OSError: another program, which `strerror` names, has locked it, or its folder is not writable.
        """
        self._file: int | None = None
        path = Path(os.path.realpath(path))
        self._path = path / ".lock" if path.is_dir() else path.with_name(f".{path.name}.lock")
        if path.exists() and not (path.is_dir() or path.is_file()):
            return
        try:
            while self._file is None:
                self._file = self._locked()
        except OSError as error:
            raise OSError(error.errno, error.strerror, str(path)) from None

    def release(self) -> None:
        """Unlock."""
        if self._file is None:
            return
        with contextlib.suppress(OSError):  # Windows cannot remove an open file
            self._path.unlink()  # before another program may lock it
        os.close(self._file)
        self._file = None

    def __del__(self) -> None:
        self.release()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.release()

    def _locked(self) -> int | None:
        """Return the open, locked file; None if its last holder has just removed it."""
        try:
            file = os.open(self._path, os.O_RDWR | _FLAGS, 0o666)
        except PermissionError:  # another user's file
            file = os.open(self._path, os.O_RDONLY | _FLAGS, 0o666)
        try:
            _lock(file)
        except OSError as error:
            holder = _holder(file)
            if error.errno in _IN_USE:
                os.close(file)
                raise OSError(errno.EBUSY, f"{holder} writes it: end that, or choose another name") from None
        with contextlib.suppress(FileNotFoundError):
            if os.path.samestat(os.fstat(file), os.stat(self._path, follow_symlinks=False)):
                return file
        os.close(file)
        return None


def _holder(file: int) -> str:
    """Name the process that holds the lock, if /proc/locks lists it."""
    end = f":{os.fstat(file).st_ino}"
    with contextlib.suppress(OSError, IndexError), open("/proc/locks", encoding="ascii") as table:  # Linux alone has it
        for fields in map(str.split, table):
            if fields[1] == "FLOCK" and fields[5].endswith(end):
                name = Path(f"/proc/{fields[4]}/comm").read_bytes().decode(errors="replace").strip()
                return f"process {fields[4]} ({printable(name)})"
    return "another program"
