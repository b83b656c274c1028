"""Reading of whole input files, with limits in bytes and time.

Every error is an `OSError` whose `strerror` is a sentence for the user. Existence is tested with `os.path`, which
returns False for invalid names; `pathlib` raises for some of them.
"""

import errno
import io
import math
import os
import re
import select
import stat
import sys
import time
from collections.abc import Iterable, Iterator
from typing import BinaryIO, TypeAlias

AnyPath: TypeAlias = str | os.PathLike[str]

MAX_BYTES = 64 * 1024 * 1024
"""Maximum size of a description or text; the largest published ones have a few MB."""
_CHUNK_BYTES = 64 * 1024
_TIMEOUT_S = 60.0
"""Time limit for a pipe, as for `<param command>`."""
_DESCRIPTOR = re.compile(r"/dev/stdin|(?:/dev|/proc/self)/fd/(\d{1,9})")
_STREAMS = {stat.S_IFIFO: "a pipe", stat.S_IFCHR: "a device", stat.S_IFSOCK: "a socket"}
_FLAGS = ("O_NONBLOCK", "O_NOCTTY", "O_BINARY", "O_CLOEXEC")
_OPEN = os.O_RDONLY | sum(getattr(os, flag, 0) for flag in _FLAGS)
"""Flags that open a pipe without a writer at once."""


def read_file(path: AnyPath, /, *, max_bytes: int = MAX_BYTES) -> bytes:
    """Read a regular file.

    Args:
        path: path of the file.
        max_bytes: size limit, checked while reading: files may grow, and those of /proc have size 0.

    Raises:
        OSError: no such file, a pipe, device or folder, a larger one, or one that cannot be read.
    """
    with open_file(path) as file:
        return _joined(iter(lambda: file.read(_CHUNK_BYTES), b""), max_bytes, path)


def read_text(path: AnyPath, /, *, max_bytes: int = MAX_BYTES) -> str:
    """Read a regular file as UTF-8 with invalid bytes replaced and Unix line ends.

    Raises:
        OSError: see `read_file`.
    """
    return read_file(path, max_bytes=max_bytes).decode(errors="replace").replace("\r\n", "\n").replace("\r", "\n")


def open_file(path: AnyPath, /) -> BinaryIO:
    """Open a regular file for random access.

    Raises:
        OSError: no such file, a pipe, device or folder, or one that cannot be opened.
    """
    try:
        _refuse_irregular(os.stat(path).st_mode, path)  # opening some devices has side effects
        file = os.fdopen(os.open(path, _OPEN), "rb")
    except ValueError:  # a NUL or half of a surrogate pair in the name
        raise FileNotFoundError(errno.ENOENT, "no file can have this name", os.fspath(path)) from None
    try:
        _refuse_irregular(os.fstat(file.fileno()).st_mode, path)
    except OSError:
        file.close()
        raise
    return file


def read_input(path: AnyPath, /) -> bytes:
    """Read a file or pipe of the command line.

    Raises:
        OSError: see `read_file` and `read_stream`.
    """
    return read_stream(path) if is_stream(path) else read_file(path)


def is_stream(path: AnyPath, /) -> bool:
    """True for a pipe, device, socket or open descriptor; False for files, folders and missing paths."""
    try:
        is_descriptor = _DESCRIPTOR.fullmatch(os.fspath(path)) is not None
        return stat.S_IFMT(os.stat(path).st_mode) in _STREAMS or is_descriptor
    except (OSError, ValueError):
        return False


def read_stream(path: AnyPath, /) -> bytes:
    """Read a stream of the command line, such as `<(xacro robot.xacro)` or /dev/stdin.

    Raises:
        OSError: it has no end within a minute or `MAX_BYTES`, or cannot be read.
    """
    name = os.fspath(path)
    match = _DESCRIPTOR.fullmatch(name)
    # A pipe of this process is duplicated: reopened, it would miss the writer's end.
    descriptor = os.open(path, _OPEN) if match is None else os.dup(int(match[1] or 0))
    try:
        return _joined(_chunks(descriptor, name), MAX_BYTES, name)
    finally:
        os.close(descriptor)


def read_standard_input() -> bytes:
    """Read standard input to its end; a terminal has no time limit.

    Raises:
        OSError: see `read_stream`.
    """
    stream = sys.stdin
    try:
        descriptor = 0 if stream is None else stream.fileno()
    except (AttributeError, io.UnsupportedOperation):  # a stream without a descriptor, such as a StringIO
        return sys.stdin.read().encode()
    return _joined(_chunks(descriptor, "<stdin>"), MAX_BYTES, "<stdin>")


def _refuse_irregular(mode: int, path: AnyPath) -> None:
    if stat.S_ISDIR(mode):
        raise IsADirectoryError(errno.EISDIR, "it is a folder, not a file", os.fspath(path))
    if not stat.S_ISREG(mode):
        kind = _STREAMS.get(stat.S_IFMT(mode), "a device")
        raise OSError(errno.EINVAL, f"it is {kind}, not a regular file", os.fspath(path))


def _joined(chunks: Iterable[bytes], max_bytes: int, path: AnyPath) -> bytes:
    parts: list[bytes] = []
    remaining = max_bytes
    for chunk in chunks:
        parts.append(chunk)
        remaining -= len(chunk)
        if remaining < 0:
            raise OSError(errno.EFBIG, f"larger than {max_bytes} bytes, the largest file read", os.fspath(path))
    return b"".join(parts)


def _chunks(descriptor: int, name: str) -> Iterator[bytes]:
    deadline_s = time.monotonic() + (math.inf if os.isatty(descriptor) else _TIMEOUT_S)
    while (remaining := deadline_s - time.monotonic()) > 0.0 and _has_more(descriptor, remaining):
        chunk = os.read(descriptor, _CHUNK_BYTES)
        if not chunk:
            return
        yield chunk
    raise TimeoutError(errno.ETIMEDOUT, f"no end of the stream within {_TIMEOUT_S:g} s", name)


def _has_more(descriptor: int, timeout_s: float) -> bool:
    """Wait for bytes or the end of a stream; without poll() the read itself blocks."""
    if not hasattr(select, "poll"):
        return True
    poll = select.poll()
    poll.register(descriptor, select.POLLIN)
    return bool(poll.poll(None if timeout_s == math.inf else timeout_s * 1000.0))
