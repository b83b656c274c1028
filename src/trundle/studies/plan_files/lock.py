"""Lock on a folder of results, so that only one sweep writes to it."""

import errno
from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path

from trundle.base.diagnostics import UsageError
from trundle.base.file_lock import FileLock


@contextmanager
def lock_folder(folder: Path) -> Generator[None]:
    """Lock a folder, created if missing; the end of the process always releases the lock.

    Raises:
        UsageError: another sweep holds the lock, or the folder cannot be written.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        lock = FileLock(folder)
    except OSError as error:
        advice = "" if error.errno == errno.EBUSY else "; give another folder with -o"
        raise UsageError(f"{folder}: {error.strerror}{advice}") from None
    with lock:
        yield
