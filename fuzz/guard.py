"""Guard against side effects of inputs: started programs, connections to other machines, files written elsewhere."""

import os
import sys
from collections.abc import Sequence
from pathlib import Path

_PROGRAMS = frozenset({"subprocess.Popen", "os.exec", "os.fork", "os.posix_spawn", "os.spawn", "os.system"})
_CHANGES = frozenset({"os.mkdir", "os.remove", "os.rename", "os.link", "os.symlink", "shutil.rmtree", "os.truncate"})


class ForbiddenError(BaseException):
    """Forbidden side effect of an input; no reader may catch it."""


def forbid(folders: Sequence[Path]) -> None:
    """Forbid such side effects in every thread; files can be written only in some folders."""
    prefixes = (*(os.path.realpath(folder) + os.sep for folder in folders), "/dev/shm/", "/dev/null")

    def is_inside(path: object) -> bool:
        if isinstance(path, bytes):
            path = os.fsdecode(path)
        return not isinstance(path, str) or (os.path.realpath(path) + os.sep).startswith(prefixes)  # or a descriptor

    def check(event: str, arguments: tuple[object, ...]) -> None:
        if event in _PROGRAMS:
            raise ForbiddenError(f"{event} {arguments[:2]!r}")
        if event == "socket.connect":
            address = arguments[1]
            if isinstance(address, tuple) and str(address[0]) not in ("127.0.0.1", "localhost", "::1"):
                raise ConnectionRefusedError("connections to other machines are forbidden while fuzzing")
        elif event == "socket.getaddrinfo":
            if str(arguments[0]) not in ("127.0.0.1", "localhost", "::1"):
                raise OSError("name look-ups are forbidden while fuzzing")
        elif (event in _CHANGES or (event == "open" and _writes(arguments))) and not is_inside(arguments[0]):
            raise ForbiddenError(f"{event} {arguments[0]!r}")

    sys.addaudithook(check)


def _writes(arguments: tuple[object, ...]) -> bool:
    flags = arguments[2]
    return isinstance(flags, int) and bool(flags & (os.O_WRONLY | os.O_RDWR))
