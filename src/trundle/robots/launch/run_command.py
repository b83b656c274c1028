"""Execution of a program with captured output, bounded in size but not in time, as in roslaunch."""

import contextlib
import os
import signal
import subprocess
import sys
import threading
from collections.abc import Callable, Mapping, Sequence
from typing import IO

from trundle.base.waiting import WaitNotice

_MAX_BYTES = 64 * 1024 * 1024
"""Output limit; the largest robot descriptions are a few MB."""
_CHUNK_BYTES = 65536
_POLL_S = 0.5


def run_command(argv: Sequence[str], /, *, env: Mapping[str, str]) -> str:
    """Run a program without a shell; standard error is passed on.

    Raises:
        ValueError: the program cannot be run, failed, or wrote too much and was killed with its children.
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
        notice = WaitNotice(f"command {argv[0]!r}")
        try:
            while any(reader.is_alive() for reader in readers):
                readers[0].join(_POLL_S)
                readers[1].join(_POLL_S if not readers[0].is_alive() else 0.0)
                notice.poll()
            process.wait()
        except BaseException:  # such as Ctrl-C, which does not reach a process in its own session
            _kill(process)
            raise
    output, errors = (bytes(reader.data) for reader in readers)
    if any(reader.is_full for reader in readers):
        raise ValueError(f"command {argv[0]!r} wrote more than {_MAX_BYTES // 2**20} MiB")
    if process.returncode != 0:
        tail = errors.decode(errors="replace").strip().splitlines()[-10:]
        output_tail = ": " + "\n".join(tail) if tail else ""
        raise ValueError(f"command {argv[0]!r} returned {process.returncode}{output_tail}")
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
        with contextlib.suppress(ValueError):  # the stream was closed
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
            return  # the process has already exited
    else:
        process.kill()
