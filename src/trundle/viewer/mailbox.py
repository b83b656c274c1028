"""A latest-wins slot between two processes: the newest message replaces the one nobody has taken.

Writer and reader share mapped memory and never wait for each other. Two halves alternate: message n lies in
half n % 2, and two counters say which messages were begun and which are done, so that a reader knows whether
the half it copied was overwritten meanwhile. Where the system has it, the memory is a file without a name, which
ends with the processes that hold it, however they end; elsewhere it is a file of this user's that is removed as soon
as the reader has it. (`multiprocessing.shared_memory` has a name, which stays behind when both are killed.)
"""

import mmap
import os
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Self

import numpy as np

_HEADER_BYTES = 64
_NEVER_WAIT = getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_NOCTTY", 0) | getattr(os, "O_BINARY", 0)
"""A number of another process may be a pipe or a terminal by now."""
_BEGUN, _DONE, _LENGTHS = 0, 1, 2


@dataclass(frozen=True, slots=True)
class BoxAddress:
    """Where another process of this user finds a box."""

    path: Path
    inode: int
    """A path of /proc names whatever has the number now."""


class Mailbox:
    """One direction, one writer, one reader."""

    def __init__(self, address: BoxAddress, memory: mmap.mmap, descriptor: int | None = None) -> None:
        self.address = address
        self._memory = memory
        self._descriptor = descriptor
        """Keeps a file without a name to be found."""
        self._header = np.frombuffer(memory, dtype=np.int64, count=_HEADER_BYTES // 8)
        self._half_bytes = (len(memory) - _HEADER_BYTES) // 2
        self._taken = 0

    @classmethod
    def create(cls, capacity_bytes: int) -> Self:
        """Make the memory; raises OSError where there is no room."""
        size = _HEADER_BYTES + 2 * capacity_bytes
        try:
            descriptor = os.memfd_create("trundle-mailbox", os.MFD_CLOEXEC)
        except (AttributeError, OSError):  # another system, or a sandbox that forbids it
            return cls._create_named(size)
        try:
            os.posix_fallocate(descriptor, 0, size)  # pages that cannot be had later would end the process
            address = BoxAddress(Path(f"/proc/{os.getpid()}/fd/{descriptor}"), os.fstat(descriptor).st_ino)
            return cls(address, mmap.mmap(descriptor, size), descriptor)
        except OSError:
            os.close(descriptor)
            raise

    @classmethod
    def _create_named(cls, size: int) -> Self:
        descriptor, name = tempfile.mkstemp(prefix=f"trundle-{os.getpid()}-")  # only this user may open it
        try:
            with os.fdopen(descriptor, "w+b") as file:
                file.write(bytes(size))
                file.flush()
                address = BoxAddress(Path(name), os.fstat(descriptor).st_ino)
                return cls(address, mmap.mmap(descriptor, size))
        except OSError:
            Path(name).unlink()
            raise

    @classmethod
    def open(cls, address: BoxAddress) -> Self:
        """Map the memory another process made.

        Raises:
            FileNotFoundError: that process has let go of it.
        """
        try:
            descriptor = os.open(address.path, os.O_RDWR | _NEVER_WAIT)
        except OSError as error:
            raise FileNotFoundError(f"no mailbox at {address.path}: {error.strerror}") from None
        with os.fdopen(descriptor, "r+b") as file:
            if os.fstat(descriptor).st_ino != address.inode:
                raise FileNotFoundError(f"no mailbox at {address.path} any more")
            return cls(address, mmap.mmap(file.fileno(), 0))

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
        """Have no other process find it; both sides keep the memory as long as they hold it."""
        descriptor, self._descriptor = self._descriptor, None
        if descriptor is not None:
            os.close(descriptor)
        elif self.address.path.parts[1] != "proc":
            self.address.path.unlink(missing_ok=True)
