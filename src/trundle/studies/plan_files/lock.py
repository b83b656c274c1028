"""Lock on a folder of results: two sweeps must not write the same one."""

import errno
from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path

from trundle.base.diagnostics import UsageError
from trundle.base.file_lock import FileLock


@contextmanager
def lock_folder(folder: Path) -> Generator[None]:
    """Hold a folder, which is made if it is not there; the lock ends with the process, however that ends.

    Raises:
        UsageError: another sweep holds it, or it cannot be written.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        lock = FileLock(folder)
    except OSError as error:
        advice = "" if error.errno == errno.EBUSY else "; give another folder with -o"
        raise UsageError(f"{folder}: {error.strerror}{advice}") from None
    with lock:
        yield
