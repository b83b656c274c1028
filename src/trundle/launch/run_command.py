"""Runs a program and captures its output, bounded in time and size."""

import contextlib
import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Mapping, Sequence
from typing import IO

_MAX_BYTES = 64 * 1024 * 1024
"""Output limit; the largest robot descriptions are a few MB."""
_CHUNK_BYTES = 65536
_QUIET_S = 5.0
"""Delay of the "still waiting" message."""
_LAST_S = 1.0
"""Grace period after a kill: a surviving child may hold the output open."""


def run_command(argv: Sequence[str], /, *, env: Mapping[str, str], timeout_s: float) -> str:
    """Run a program without a shell; standard error is passed on.

    Raises:
        ValueError: the program cannot be run, failed, timed out or wrote too much; it is killed with its children.
    """
    pipe = subprocess.PIPE
    try:
        process = subprocess.Popen(
            argv, stdin=subprocess.DEVNULL, stdout=pipe, stderr=pipe, env=dict(env), start_new_session=True
        )
    except FileNotFoundError:
        raise ValueError(f"no such command {argv[0]!r}") from None
    except OSError as error:
        raise ValueError(f"command {argv[0]!r} cannot be run: {error.strerror}") from None
    with process:
        assert process.stdout is not None
        assert process.stderr is not None
        readers = [_Reader(stream, lambda: _kill(process)) for stream in (process.stdout, process.stderr)]
        due = time.monotonic() + timeout_s
        readers[0].join(min(_QUIET_S, timeout_s))
        if readers[0].is_alive() and timeout_s > _QUIET_S:
            print(f"still waiting for command {argv[0]!r}, {timeout_s:g} s at most", file=sys.stderr)
        for reader in readers:
            reader.join(max(0.0, due - time.monotonic()))
        is_late = any(reader.is_alive() for reader in readers)
        try:
            process.wait(max(0.0, due - time.monotonic()))
        except subprocess.TimeoutExpired:
            is_late = True
        if is_late:
            _kill(process)
            for reader in readers:
                reader.join(_LAST_S)
    output, errors = (bytes(reader.data) for reader in readers)
    if any(reader.is_full for reader in readers):
        raise ValueError(f"command {argv[0]!r} wrote more than {_MAX_BYTES // 2**20} MiB")
    if is_late:
        raise ValueError(f"command {argv[0]!r} did not finish within {timeout_s:g} s")
    if process.returncode != 0:
        last = errors.decode(errors="replace").strip().splitlines()[-10:]
        said = ": " + "\n".join(last) if last else ""
        raise ValueError(f"command {argv[0]!r} returned {process.returncode}{said}")
    if errors:
        print(errors.decode(errors="replace"), end="", file=sys.stderr)
    try:
        return output.decode()
    except UnicodeDecodeError:
        raise ValueError(f"command {argv[0]!r} wrote output that is not UTF-8 text") from None


class _Reader(threading.Thread):
    """Reads a stream to its end or the size limit."""

    def __init__(self, stream: IO[bytes], when_full: Callable[[], None]) -> None:
        super().__init__(daemon=True)
        self.data = bytearray()
        self.is_full = False
        self._stream = stream
        self._when_full = when_full
        self.start()

    def run(self) -> None:
        with contextlib.suppress(ValueError):  # abandoned and closed
            while chunk := os.read(self._stream.fileno(), _CHUNK_BYTES):
                self.data += chunk
                if len(self.data) > _MAX_BYTES:
                    self.is_full = True
                    self._when_full()
                    return


def _kill(process: subprocess.Popen[bytes]) -> None:
    if os.name == "posix":
        try:
            os.killpg(process.pid, signal.SIGKILL)
        except ProcessLookupError:
            return  # already exited
    else:
        process.kill()
