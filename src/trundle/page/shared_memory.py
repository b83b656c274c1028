"""Memory shared by two processes of one user.

On Linux it is an anonymous file, which the system frees once no process uses it; elsewhere a private file until
`unlink`. (`multiprocessing.shared_memory` is named, and leaks when both processes are killed.)
"""

import mmap
import os
import tempfile
from pathlib import Path

import msgspec

_NEVER_WAIT = getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_NOCTTY", 0) | getattr(os, "O_BINARY", 0)
"""Flags for opening: a descriptor of another process may have become a pipe or a terminal."""


class MemoryAddress(msgspec.Struct, frozen=True):
    """Address by which another process of this user opens the memory."""

    path: str
    inode: int
    """Identifies the file, since a descriptor's path in /proc may later name another file."""


class SharedMemory:
    """Mapped memory; others can open it until its creator calls `unlink`."""

    def __init__(self, address: MemoryAddress, memory: mmap.mmap, descriptor: int | None = None) -> None:
        self.address = address
        self.memory = memory
        self._descriptor = descriptor
        """Keeps the path of an anonymous file valid."""

    @classmethod
    def create(cls, size: int) -> "SharedMemory":
        """Allocate memory [bytes].

        Raises:
            OSError: there is not enough memory.
        """
        try:
            descriptor = os.memfd_create("trundle-page", os.MFD_CLOEXEC)
        except (AttributeError, OSError):  # not Linux, or forbidden by a sandbox
            return cls._create_named(size)
        try:
            os.posix_fallocate(
                descriptor, 0, size
            )  # reserves the memory: running out of it later would kill the process
            address = MemoryAddress(f"/proc/{os.getpid()}/fd/{descriptor}", os.fstat(descriptor).st_ino)
            return cls(address, mmap.mmap(descriptor, size), descriptor)
        except OSError:
            os.close(descriptor)
            raise

    @classmethod
    def _create_named(cls, size: int) -> "SharedMemory":
        descriptor, name = tempfile.mkstemp(prefix=f"trundle-{os.getpid()}-")  # only this user may open it
        try:
            with os.fdopen(descriptor, "w+b") as file:
                file.write(bytes(size))
                file.flush()
                return cls(MemoryAddress(name, os.fstat(descriptor).st_ino), mmap.mmap(descriptor, size))
        except OSError:
            Path(name).unlink()
            raise

    @classmethod
    def open(cls, address: MemoryAddress) -> "SharedMemory":
        """Map the memory of another process.

        Raises:
            FileNotFoundError: that process has released it.
        """
        try:
            descriptor = os.open(address.path, os.O_RDWR | _NEVER_WAIT)
        except OSError as error:
            raise FileNotFoundError(f"no memory at {address.path}: {error.strerror}") from None
        with os.fdopen(descriptor, "r+b") as file:
            if os.fstat(descriptor).st_ino != address.inode:
                raise FileNotFoundError(f"another file at {address.path}")
            return cls(address, mmap.mmap(file.fileno(), 0))

    def unlink(self) -> None:
        """Remove the address; processes that have mapped the memory keep it."""
        descriptor, self._descriptor = self._descriptor, None
        if descriptor is not None:
            os.close(descriptor)
        elif not self.address.path.startswith("/proc/"):
            Path(self.address.path).unlink(missing_ok=True)
