"""Latest-value mailbox between two processes: the newest message replaces an unread one.

Writer and reader share memory and never wait for each other. Two halves alternate: message n is in half n % 2, and two
counters hold the numbers of the last started and the last finished message, from which a reader detects that its half
was overwritten while it was copied.
"""

from collections.abc import Sequence
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from .shared_memory import MemoryAddress, SharedMemory

Piece: TypeAlias = bytes | NDArray[np.uint8]
_HEADER_BYTES = 64
_STARTED, _FINISHED, _LENGTHS = 0, 1, 2


class Mailbox:
    """Mailbox with one writer and one reader."""

    def __init__(self, shared: SharedMemory) -> None:
        self._shared = shared
        self._bytes = np.frombuffer(shared.memory, dtype=np.uint8)
        self._header = np.frombuffer(shared.memory, dtype=np.int64, count=_HEADER_BYTES // 8)
        self._half_bytes = (len(shared.memory) - _HEADER_BYTES) // 2
        self._read = 0

    @classmethod
    def create(cls, capacity_bytes: int) -> "Mailbox":
        """Allocate the memory; raises OSError if there is not enough."""
        return cls(SharedMemory.create(_HEADER_BYTES + 2 * capacity_bytes))

    @classmethod
    def open(cls, address: MemoryAddress) -> "Mailbox":
        """Map the memory of another process; raises FileNotFoundError if that process has released it."""
        return cls(SharedMemory.open(address))

    @property
    def address(self) -> MemoryAddress:
        """Address by which another process opens it."""
        return self._shared.address

    @property
    def capacity_bytes(self) -> int:
        """Length of the longest message."""
        return self._half_bytes

    def put(self, pieces: Sequence[Piece]) -> None:
        """Replace the message; the pieces are copied one after another."""
        number = int(self._header[_FINISHED]) + 1
        self._header[_STARTED] = number
        start = end = _HEADER_BYTES + (number % 2) * self._half_bytes
        for piece in pieces:
            assert end + len(piece) <= start + self._half_bytes, "the message is longer than the mailbox"
            if len(piece):
                self._bytes[end : end + len(piece)] = np.frombuffer(piece, dtype=np.uint8)
            end += len(piece)
        self._header[_LENGTHS + number % 2] = end - start
        self._header[_FINISHED] = number

    def read(self) -> bytes | None:
        """Return the newest message; None if it was read already or is being overwritten."""
        number = int(self._header[_FINISHED])
        if number == self._read:
            return None
        start = _HEADER_BYTES + (number % 2) * self._half_bytes
        message = self._bytes[start : start + int(self._header[_LENGTHS + number % 2])].tobytes()
        if int(self._header[_STARTED]) > number + 1:
            return None
        self._read = number
        return message

    def unlink(self) -> None:
        """Remove the mailbox's address; processes that have opened the mailbox keep the memory."""
        self._shared.unlink()
