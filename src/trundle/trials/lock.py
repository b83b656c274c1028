"""Lock on a folder of results: two sweeps must not write the same one."""

from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path
from typing import IO

from trundle.diagnostics import UsageError

try:
    import fcntl
except ModuleNotFoundError:

    def _lock(file: IO[bytes]) -> None:
        import msvcrt

        file.seek(0)
        msvcrt.locking(file.fileno(), msvcrt.LK_NBLCK, 1)  # pyright: ignore[reportAttributeAccessIssue]
else:

    def _lock(file: IO[bytes]) -> None:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)


@contextmanager
def lock_folder(folder: Path) -> Generator[None]:
    """Hold a folder, which is made if it is not there; the lock ends with the process, however that ends.

    Raises:
        UsageError: another sweep holds it, or it cannot be written.
    """
    path = folder / ".lock"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        file = path.open("ab")
    except OSError as error:
        raise UsageError(f"{folder}: {error.strerror}; give another folder with -o") from None
    with file:
        try:
            _lock(file)
        except OSError:
            raise UsageError(f"another sweep writes {folder}; wait for it, or give another folder with -o") from None
        yield
