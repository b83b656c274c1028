"""Memory that two processes of one user map.

Where the system has it, a file without a name, which ends with the processes that hold it, however they end; elsewhere
a file of this user's that is removed once it is mapped. (`multiprocessing.shared_memory` has a name, which stays behind
when both processes are killed.)
"""

import mmap
import os
import tempfile
from pathlib import Path

import msgspec

_NEVER_WAIT = getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_NOCTTY", 0) | getattr(os, "O_BINARY", 0)
"""A descriptor number of another process may be a pipe or a terminal by now."""


class MemoryAddress(msgspec.Struct, frozen=True):
    """Place where another process of this user finds the memory."""

    path: str
    inode: int
    """A path in /proc names whatever has the number now."""


class SharedMemory:
    """Mapped memory; the creator keeps it to be found until `unlink`."""

    def __init__(self, address: MemoryAddress, memory: mmap.mmap, descriptor: int | None = None) -> None:
        self.address = address
        self.memory = memory
        self._descriptor = descriptor
        """Keeps a file without a name to be found."""

    @classmethod
    def create(cls, size: int) -> "SharedMemory":
        """Allocate memory [bytes].

        Raises:
            OSError: there is no room.
        """
        try:
            descriptor = os.memfd_create("trundle-page", os.MFD_CLOEXEC)
        except (AttributeError, OSError):  # another system, or a sandbox that forbids it
            return cls._create_named(size)
        try:
            os.posix_fallocate(descriptor, 0, size)  # pages that cannot be had later would end the process
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
            FileNotFoundError: that process has let go of it.
        """
        try:
            descriptor = os.open(address.path, os.O_RDWR | _NEVER_WAIT)
        except OSError as error:
            raise FileNotFoundError(f"no memory at {address.path}: {error.strerror}") from None
        with os.fdopen(descriptor, "r+b") as file:
            if os.fstat(descriptor).st_ino != address.inode:
                raise FileNotFoundError(f"no memory at {address.path} any more")
            return cls(address, mmap.mmap(file.fileno(), 0))

    def unlink(self) -> None:
        """Have no other process find it; both sides keep the memory as long as they hold it."""
        descriptor, self._descriptor = self._descriptor, None
        if descriptor is not None:
            os.close(descriptor)
        elif not self.address.path.startswith("/proc/"):
            Path(self.address.path).unlink(missing_ok=True)
