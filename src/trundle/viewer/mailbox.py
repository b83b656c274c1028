"""A latest-wins slot between two processes: the newest message replaces the one nobody has taken.

Writer and reader share a mapped file and never wait for each other. Two halves alternate: message n lies in
half n % 2, and two counters say which messages were begun and which are done, so that a reader knows whether
the half it copied was overwritten meanwhile. (`multiprocessing.shared_memory` would do for the bytes, but on
Python 3.11 a process that merely attaches has its resource tracker remove the block when it ends.)
"""

import mmap
import os
import tempfile
from pathlib import Path
from typing import Self

import numpy as np

_HEADER_BYTES = 64
_BEGUN, _DONE, _LENGTHS = 0, 1, 2


class Mailbox:
    """One direction, one writer, one reader."""

    def __init__(self, path: Path, memory: mmap.mmap) -> None:
        self.path = path
        self._memory = memory
        self._header = np.frombuffer(memory, dtype=np.int64, count=_HEADER_BYTES // 8)
        self._half_bytes = (len(memory) - _HEADER_BYTES) // 2
        self._taken = 0

    @classmethod
    def create(cls, capacity_bytes: int) -> Self:
        """Make the file, in memory where the system has such a folder; raises OSError where there is no room."""
        size = _HEADER_BYTES + 2 * capacity_bytes
        shared = Path("/dev/shm")
        try:
            return cls._create_in(shared if shared.is_dir() else None, size)
        except OSError:
            return cls._create_in(None, size)  # a container's /dev/shm may be tiny or not ours to write

    @classmethod
    def _create_in(cls, folder: Path | None, size: int) -> Self:
        descriptor, name = tempfile.mkstemp(prefix=f"trundle-{os.getpid()}-", dir=folder)
        try:
            with os.fdopen(descriptor, "w+b") as file:
                # Pages that cannot be had must fail here: touched later they would end the process with SIGBUS.
                file.write(bytes(size))
                file.flush()
                return cls(Path(name), mmap.mmap(file.fileno(), size))
        except OSError:
            Path(name).unlink()
            raise

    @classmethod
    def open(cls, path: Path) -> Self:
        """Map the file another process made."""
        with path.open("r+b") as file:
            return cls(path, mmap.mmap(file.fileno(), 0))

    @property
    def capacity_bytes(self) -> int:
        """The longest message."""
        return self._half_bytes

    def put(self, message: bytes | memoryview) -> None:
        """Replace whatever lies there."""
        assert len(message) <= self._half_bytes, f"{len(message)} bytes do not fit in {self._half_bytes}"
        number = int(self._header[_DONE]) + 1
        self._header[_BEGUN] = number
        start = _HEADER_BYTES + (number % 2) * self._half_bytes
        self._memory[start : start + len(message)] = bytes(message)
        self._header[_LENGTHS + number % 2] = len(message)
        self._header[_DONE] = number

    def take(self) -> bytes | None:
        """Return the newest message, or None if it was taken before (or was overwritten this very moment)."""
        number = int(self._header[_DONE])
        if number == self._taken:
            return None
        start = _HEADER_BYTES + (number % 2) * self._half_bytes
        message = self._memory[start : start + int(self._header[_LENGTHS + number % 2])]
        if int(self._header[_BEGUN]) > number + 1:
            return None
        self._taken = number
        return message

    def unlink(self) -> None:
        """Remove the name; both sides keep the memory as long as they hold it."""
        self.path.unlink(missing_ok=True)
